#!/usr/bin/env python3
"""nacre against Blender's Cycles on the benchmark scenes, one after the other in the same run.

    bench/against_cycles.py [--nacre build/release/nacre] [--quick]

For each scene of ../shared/bench: nacre's reference picture (another seed, kept in build/peers), then both renderers,
and a table of wall and CPU seconds, relMSE over the bunny's pixels (bench/relmse.py) and the wall time to relMSE 0.01.
That time follows from error times time, since error falls as one over the samples; nacre's is measured near 0.01
because heavy tails make an extrapolation from few samples too good, Cycles' marble is extrapolated, which favours
Cycles. The reference's own noise, known from the same law, is taken off. `--quick` takes a quarter of all samples.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

import relmse

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT / ".." / "shared" / "bench"
PEERS = ROOT / "build" / "peers"
TARGET = 0.01
# Samples per pixel: nacre's reference, nacre, Cycles.
SCENES = {"marble": (320, 64, 4), "diffuse": (1024, 48, 48)}


def run(command):
    """Wall and CPU seconds of a command, and what it printed."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{command[0]} failed:\n{done.stderr[-2000:]}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def nacre(binary, scene, spp, seed, out):
    # The scene with Sobol' points, which Cycles uses too.
    text = (SHARED / f"{scene}_bunny.xml").read_text()
    file = PEERS / f"{scene}_bunny.xml"
    file.write_text(text.replace('type="independent"', 'type="sobol"')
                    .replace("bunny_watertight.obj", str((SHARED / "bunny_watertight.obj").resolve())))
    wall, cpu, text = run([binary, "render", file, "-o", out, "--spp", spp, "--seed", seed, "--quiet", "--json"])
    return wall, cpu, json.loads(text)


def cycles(scene, spp, out):
    wall, cpu, text = run(["blender", "-b", "--factory-startup", "-P", ROOT / "bench/cycles/render_scene.py", "--", scene,
                           "--bunny", SHARED / "bunny_watertight.obj", "--spp", spp, "--out", out])
    # Start-up and the building of the scene are not rendering; the script prints what rendering took.
    rendering = re.search(r"wall_s ([0-9.]+)", text, re.M)
    return float(rendering.group(1)) if rendering else wall, cpu


def error(picture, reference, mask):
    *_, a = relmse.read_exr(picture)
    *_, b = relmse.read_exr(reference)
    *_, weights = relmse.read_exr(mask)
    return relmse.compare(a, b, [i for i, green in enumerate(weights["G"]) if green > 0.5], 0.001)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nacre", default=ROOT / "build/release/nacre")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    arguments = parser.parse_args()
    if not (SHARED / "bunny_watertight.obj").exists():
        sys.exit(f"The benchmark scenes are not in {SHARED}.")
    os.makedirs(PEERS, exist_ok=True)
    mask = PEERS / "mask.exr"
    if not mask.exists():
        cycles("mask", 16, mask)
    for scene in arguments.scenes:
        spp_reference, spp_nacre, spp_cycles = (n // 4 if arguments.quick else n for n in SCENES[scene])
        reference = PEERS / f"reference_{scene}_{spp_reference}.exr"
        if not reference.exists():
            nacre(arguments.nacre, scene, spp_reference, 1000, reference)
        print(f"{scene}: renderer, spp, wall s, CPU s, relMSE, wall s to relMSE {TARGET}, mean RGB")
        picture = PEERS / f"{scene}_nacre.exr"
        wall, cpu, summary = nacre(arguments.nacre, scene, spp_nacre, 0, picture)
        means, total = error(picture, reference, mask)
        # total = own + reference, own / reference = spp_reference / spp_nacre
        own = total / (1 + spp_nacre / spp_reference)
        noise = total - own
        ours = wall * own / TARGET
        row(f"nacre {scene}", spp_nacre, wall, cpu, own, ours, means["picture"])
        print("  " + ", ".join(f"{k} {v}" for k, v in summary.items() if isinstance(v, (int, float))))
        picture = PEERS / f"{scene}_cycles.exr"
        wall, cpu = cycles(scene, spp_cycles, picture)
        means, total = error(picture, reference, mask)
        theirs = wall * (total - noise) / TARGET
        row(f"Cycles {scene}", spp_cycles, wall, cpu, total - noise, theirs, means["picture"])
        print(f"  Cycles needs {theirs / ours:.1f} times as long as nacre")


def row(name, spp, wall, cpu, relative, to_target, mean):
    print(f"  {name:16} {spp:5d} {wall:8.1f} {cpu:8.1f} {relative:9.5f} {to_target:9.1f}   "
          + " ".join(f"{m:.4f}" for m in mean), flush=True)


if __name__ == "__main__":
    main()
