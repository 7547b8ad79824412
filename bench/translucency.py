#!/usr/bin/env python3
"""The translucent experiments of the classic papers, measured in one run.

    bench/translucency.py marble [--quick]   Jensen et al. 2001: one figure with a BRDF, a BSSRDF, complete simulation
    bench/translucency.py points             Jensen and Buhler 2002: cost against the number of surface points
    bench/translucency.py bunny              the benchmark bunny (../shared/bench): every technique's mean and error

Pictures and references are kept in build/translucency. Prints tables of CPU seconds, relMSE a pixel
(bench/relmse.py) and the RMS error of blocks of pixels against complete simulation with another seed.
"""
import argparse
import json
import math
import pathlib
import subprocess

import relmse

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "build" / "translucency"
NACRE = ROOT / "build" / "release" / "nacre"


def render(scene, name, *options):
    """CPU seconds and statistics of a render; the picture goes to OUT/name.exr."""
    command = [NACRE, "render", scene, "-o", OUT / f"{name}.exr", "--quiet", "--json", *options]
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stderr[-2000:]}")
    r = json.loads(done.stdout)
    r["cpu"] = r["cpu_seconds"] + r["precompute_cpu_seconds"]
    return r


BLOCK = 16  # pixels a side: large enough for noise to average out, small enough to see where light is lost


def compare(name, reference, mask=None):
    """Mean RGB of both over the mask (a predicate of pixel index), relMSE over pixels, and the relative RMS error of
    the means of blocks, which tells bias from noise."""
    width, height, picture = relmse.read_exr(OUT / f"{name}.exr")
    _, _, truth = relmse.read_exr(OUT / f"{reference}.exr")
    inside = [mask is None or mask(i) for i in range(width * height)]
    means, errors, blocks = [], [], []
    for c in "RGB":
        pairs = [(p, t) for p, t, i in zip(picture[c], truth[c], inside) if i]
        means.append((sum(p for p, _ in pairs) / len(pairs), sum(t for _, t in pairs) / len(pairs)))
        errors += [(p - t) ** 2 / (t * t + 0.01) for p, t in pairs]
        for y in range(0, height - BLOCK + 1, BLOCK):
            for x in range(0, width - BLOCK + 1, BLOCK):
                at = [j * width + i for j in range(y, y + BLOCK) for i in range(x, x + BLOCK)]
                if all(inside[k] for k in at):
                    blocks.append(sum(picture[c][k] for k in at) / sum(truth[c][k] for k in at) - 1)
    errors.sort()
    keep = errors[:len(errors) - len(errors) // 1000]
    return means, sum(keep) / len(keep), math.sqrt(sum(b * b for b in blocks) / len(blocks))


def marble(quick):
    scene = ROOT / "scenes" / "translucency"
    spp, complete, reference = (8, 16, 32) if quick else (32, 32, 96)
    render(scene / "03_marble_complete.xml", "marble_reference", "-D", f"spp={reference}", "--seed", 77)
    rows = []
    for title, file, samples in [("BRDF", "01_marble_brdf", spp), ("BSSRDF, two passes", "02_marble_two_pass", spp),
                                 ("complete simulation", "03_marble_complete", complete)]:
        r = render(scene / f"{file}.xml", file, "-D", f"spp={samples}")
        if not rows:  # the bust is where the picture is not the background
            _, _, picture = relmse.read_exr(OUT / f"{file}.exr")
            background = picture["G"][0]
            bust = [abs(g - background) > 1e-4 for g in picture["G"]]
        means, error, blocks = compare(file, "marble_reference", lambda i: bust[i])
        rows.append((title, samples, r["cpu"], error, blocks, [p / t for p, t in means]))
    print(f"{'marble, lit from behind':<24} {'spp':>4} {'CPU s':>8} {'RMS of blocks':>14}  mean over complete, RGB")
    for title, samples, cpu, _, blocks, ratio in rows:
        print(f"{title:<24} {samples:>4} {cpu:>8.1f} {blocks:>14.3f}  " + " ".join(f"{x:.3f}" for x in ratio))
    # Two simulations differ by the noise of both; error falls as one over the samples.
    noise = rows[2][3] / (1 / complete + 1 / reference)
    to_clean = rows[2][2] / complete * noise / 0.01
    print(f"complete simulation to a relMSE of 0.01 a pixel: {noise / 0.01:.0f} spp, {to_clean:.0f} CPU s")
    print(f"CPU, BRDF : two passes : complete = 1 : {rows[1][2] / rows[0][2]:.1f} : {to_clean / rows[0][2]:.0f}"
          "   (Jensen et al. 2001, minutes: 2 : 5 : 1250 = 1 : 2.5 : 625)")


def points(_):
    scene = ROOT / "scenes" / "translucency" / "02_marble_two_pass.xml"
    print(f"{'spacing':>8} {'points':>8} {'points s':>9} {'irradiance s':>12} {'tree s':>8} {'render CPU s':>12} {'MB':>6}")
    rows = []
    for spacing in (8, 5.6, 4, 2.8, 2, 1.4, 1):
        r = render(scene, "points", "--technique", "two_pass", "--set", f"spacing={spacing}", "--set",
                   "irradiance_samples=8", "-D", "spp=4")
        s = r["statistics"]
        rows.append((s["points"], s["points_seconds"], s["irradiance_seconds"], s["tree_seconds"], r["cpu_seconds"]))
        print(f"{spacing:>8} {s['points']:>8.0f} {s['points_seconds']:>9.2f} {s['irradiance_seconds']:>12.2f} "
              f"{s['tree_seconds']:>8.3f} {r['cpu_seconds']:>12.2f} {s['tree_bytes'] / 1e6:>6.1f}")
    for i, name in enumerate(["points", "irradiance", "tree", "render"], 1):
        xs = [math.log(r[0]) for r in rows]
        ys = [math.log(max(r[i], 1e-6)) for r in rows]
        mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
        slope = sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)
        print(f"exponent of {name:<11} {slope:.2f}")
    with open(OUT / "points.csv", "w") as file:
        file.write("points,points_s,irradiance_s,tree_s,render_cpu_s\n")
        file.writelines(",".join(f"{x:g}" for x in r) + "\n" for r in rows)


def bunny(_):
    shared = ROOT / ".." / "shared" / "bench"
    scene = shared / "marble_bunny.xml"
    text = scene.read_text().replace("bunny_watertight.obj", str((shared / "bunny_watertight.obj").resolve()))
    # The mask: a bunny that shines in the dark.
    a = text.index('<bsdf type="dielectric">')
    b = text.index("</shape>", a)
    mask = text[:a] + '<emitter type="area"><rgb name="radiance" value="1"/></emitter>' + text[b:]
    mask = mask.replace('value="20, 20, 20"', 'value="0"').replace('value="0.3, 0.3, 0.3"', 'value="0"')
    mask = mask.replace('name="max_depth" value="-1"', 'name="max_depth" value="1"').replace('"volpath"', '"path"')
    (OUT / "mask.xml").write_text(mask)
    render(OUT / "mask.xml", "mask", "--spp", 16)
    _, _, mask = relmse.read_exr(OUT / "mask.exr")
    if not (OUT / "bunny_reference.exr").exists():
        render(scene, "bunny_reference", "--spp", 128, "--seed", 77)
    print(f"{'technique':<34} {'spp':>4} {'CPU s':>7} {'before':>7} {'relMSE':>8} {'blocks':>7}  mean over complete, RGB")
    for title, samples, options in [
            ("brdf, dipole", 64, ["--technique", "brdf"]),
            ("hanrahan_krueger, dipole", 64, ["--technique", "hanrahan_krueger"]),
            ("hanrahan_krueger, better dipole", 64, ["--technique", "hanrahan_krueger", "--profile", "better_dipole"]),
            ("two_pass, dipole", 4, ["--technique", "two_pass"]),
            ("two_pass, dipole, 121,759 points", 4, ["--technique", "two_pass", "--set", "spacing=1.45"]),
            ("two_pass, dipole, exit as in paper", 4, ["--technique", "two_pass", "--set", "exit_fresnel=paper"]),
            ("two_pass, dipole", 64, ["--technique", "two_pass", "--set", "irradiance_samples=64"]),
            ("two_pass, better dipole + single", 64, ["--technique", "two_pass", "--profile", "better_dipole"]),
            ("surface, dipole", 64, ["--technique", "surface"]),
            ("surface, better dipole + single", 64, ["--technique", "surface", "--profile", "better_dipole"]),
            ("surface, quantised diff. + single", 64, ["--technique", "surface", "--profile", "quantised_diffusion"]),
            ("surface, beams + single", 64, ["--technique", "surface", "--profile", "photon_beam_diffusion"]),
            ("surface, normalised diffusion", 64, ["--technique", "surface", "--profile", "normalised_diffusion"]),
            ("random_walk, transport free path", 64, ["--technique", "random_walk"]),
            ("random_walk, diffuse free path", 64, ["--technique", "random_walk", "--set", "free_path=diffuse"]),
            ("complete simulation", 16, ["--technique", "volpath"])]:
        r = render(scene, "bunny", "--spp", samples, *options)
        means, error, blocks = compare("bunny", "bunny_reference", lambda i: mask["G"][i] > 0.5)
        print(f"{title:<34} {samples:>4} {r['cpu']:>7.1f} {r['precompute_cpu_seconds']:>7.1f} {error:>8.4f} {blocks:>7.3f}  " +
              " ".join(f"{p / t:.3f}" for p, t in means), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("experiment", choices=["marble", "points", "bunny"])
    parser.add_argument("--quick", action="store_true", help="fewer samples")
    options = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    {"marble": marble, "points": points, "bunny": bunny}[options.experiment](options.quick)


if __name__ == "__main__":
    main()
