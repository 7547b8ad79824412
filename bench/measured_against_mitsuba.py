#!/usr/bin/env python3
"""RGL's files, and those that `nacre data convert` writes, in nacre and in Mitsuba 3 (its plugin `measured`): value
and density at random pairs of directions; with --render a lit ball as well.

    PYTHONPATH=... bench/measured_against_mitsuba.py [--pairs 10000] [--render] [--nacre build/release/nacre] FILE.bsdf ...

needs the Python package mitsuba. Says for each file the largest difference over the larger of value and 1 % of
the largest value, and the median time of an evaluation in Mitsuba's scalar variant (files with wavelengths: at four
of them). Of pictures: the difference of the means, and the RMS difference over what two pictures by Mitsuba differ by,
which is 1 where both programs render the same."""
import argparse
import csv
import math
import os
import random
import subprocess
import tempfile
import time

import mitsuba as mi

SCENE = """<scene version="3.0.0">
  <integrator type="path"><integer name="max_depth" value="2"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="26"/>
    <transform name="to_world"><lookat origin="0, -5, 0" target="0, 0, 0" up="0, 0, 1"/></transform>
    <film type="hdrfilm"><integer name="width" value="96"/><integer name="height" value="96"/>
      <rfilter type="box"/></film>
    <sampler type="independent"><integer name="sample_count" value="SAMPLES"/></sampler>
  </sensor>
  <shape type="sphere"><float name="radius" value="1"/>
    <bsdf type="measured"><string name="filename" value="FILE"/></bsdf></shape>
  <emitter type="constant"><rgb name="radiance" value="0.5, 0.5, 0.5"/></emitter>
  <shape type="sphere"><float name="radius" value="0.7"/><point name="center" x="3" y="-4" z="3"/>
    <emitter type="area"><rgb name="radiance" value="12, 12, 12"/></emitter></shape>
</scene>
"""


def direction(rng):
    z = rng.uniform(0.02, 1)
    s, phi = math.sqrt(1 - z * z), rng.uniform(0, 2 * math.pi)
    return s * math.cos(phi), s * math.sin(phi), z


def at_pairs(o, file, pairs, table):
    text = subprocess.run([o.nacre, "data", "eval", file, "--pairs", table, "--rendered"],
                          check=True, capture_output=True, text=True).stdout
    names, *rows = csv.reader(text.splitlines())
    ours = [[float(x) for x in row] for row in rows]
    spectral = names[0] != "r"
    mi.set_variant("scalar_spectral" if spectral else "scalar_rgb")
    bsdf = mi.load_dict({"type": "measured", "filename": file})
    context, si = mi.BSDFContext(), mi.SurfaceInteraction3f()
    columns = list(range(3))
    if spectral:
        last = len(names) - 2
        columns = [0, last // 3, 2 * last // 3, last]
        si.wavelengths = [float(names[c]) for c in columns]
    theirs, seconds = [], []
    for light, viewer in pairs:
        si.wi = mi.Vector3f(*viewer)
        begin = time.perf_counter()
        value, pdf = bsdf.eval_pdf(context, si, mi.Vector3f(*light))
        seconds.append(time.perf_counter() - begin)
        theirs.append([max(float(v), 0) for v in value] + [float(pdf)])
    worst = [0, 0]
    for k, column in enumerate([*columns, -1]):
        kind = int(column == -1)
        floor = 0.01 * max(t[k] for t in theirs)
        for a, b in zip(ours, theirs):
            worst[kind] = max(worst[kind], abs(a[column] - b[k]) / max(b[k], floor))
    return worst, sorted(seconds)[len(seconds) // 2]


def on_a_ball(o, file, folder):
    """The current variant of Mitsuba, and nacre."""
    scene = os.path.join(folder, "ball.xml")
    samples = 256
    with open(scene, "w") as f:
        f.write(SCENE.replace("FILE", os.path.abspath(file)).replace("SAMPLES", str(samples)))
    picture = os.path.join(folder, "ball.exr")
    subprocess.run([o.nacre, "render", scene, "-o", picture, "--quiet"], check=True, capture_output=True)
    loaded = mi.load_file(scene)

    def numbers(bitmap):
        return mi.TensorXf(bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)).array

    first, second = (numbers(mi.Bitmap(mi.render(loaded, seed=seed, spp=samples))) for seed in (1, 2))
    ours = numbers(mi.Bitmap(picture))

    def rms(a, b):
        return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))

    return sum(ours) / (0.5 * (sum(first) + sum(second))) - 1, rms(ours, first) / rms(first, second)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="+")
    parser.add_argument("--pairs", type=int, default=10000)
    parser.add_argument("--render", action="store_true")
    parser.add_argument("--nacre", default="build/release/nacre")
    o = parser.parse_args()
    rng = random.Random(1)
    pairs = [(direction(rng), direction(rng)) for _ in range(o.pairs)]
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "pairs.csv")
        with open(table, "w") as f:
            for light, viewer in pairs:
                f.write(",".join(f"{x:.9g}" for x in light + viewer) + "\n")
        print(f"{'file':32} {'value':>9} {'density':>9}  {'both, Mitsuba':>13}" +
              ("   ball: mean, noise" if o.render else ""))
        for file in o.files:
            worst, seconds = at_pairs(o, file, pairs, table)
            line = f"{os.path.basename(file):32} {worst[0]:9.1e} {worst[1]:9.1e}  {seconds * 1e6:10.2f} us"
            if o.render:
                mean, noise = on_a_ball(o, file, folder)
                line += f"   {100 * mean:+6.2f} %, {noise:.2f}"
            print(line, flush=True)


if __name__ == "__main__":
    main()
