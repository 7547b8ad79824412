#!/usr/bin/env python3
"""RGL's files in nacre and in Mitsuba 3 (its plugin `measured`), value and density at random pairs of directions.

    PYTHONPATH=... bench/measured_against_mitsuba.py [--pairs 10000] [--nacre build/release/nacre] FILE.bsdf ...

needs the Python package mitsuba. Says for each file the largest difference over the larger of value and 1 % of
the largest value, and the median time of an evaluation in Mitsuba's scalar variant."""
import argparse
import csv
import math
import random
import subprocess
import tempfile
import time

import mitsuba as mi


def direction(rng):
    z = rng.uniform(0.02, 1)
    s, phi = math.sqrt(1 - z * z), rng.uniform(0, 2 * math.pi)
    return s * math.cos(phi), s * math.sin(phi), z


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="+")
    parser.add_argument("--pairs", type=int, default=10000)
    parser.add_argument("--nacre", default="build/release/nacre")
    o = parser.parse_args()
    mi.set_variant("scalar_rgb")
    rng = random.Random(1)
    pairs = [(direction(rng), direction(rng)) for _ in range(o.pairs)]
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as table:
        for light, viewer in pairs:
            table.write(",".join(f"{x:.9g}" for x in light + viewer) + "\n")
        table.flush()
        print(f"{'file':32} {'value':>9} {'density':>9}  {'both, Mitsuba':>13}")
        for file in o.files:
            text = subprocess.run([o.nacre, "data", "eval", file, "--pairs", table.name, "--rendered"],
                                  check=True, capture_output=True, text=True).stdout
            ours = [[float(x) for x in row] for row in list(csv.reader(text.splitlines()))[1:]]
            bsdf = mi.load_dict({"type": "measured", "filename": file})
            context, si = mi.BSDFContext(), mi.SurfaceInteraction3f()
            theirs, seconds = [], []
            for light, viewer in pairs:
                si.wi = mi.Vector3f(*viewer)
                begin = time.perf_counter()
                value, pdf = bsdf.eval_pdf(context, si, mi.Vector3f(*light))
                seconds.append(time.perf_counter() - begin)
                theirs.append([max(float(v), 0) for v in value] + [float(pdf)])
            worst = [0, 0]
            for column in range(4):
                floor = 0.01 * max(t[column] for t in theirs)
                kind = column // 3
                for a, b in zip(ours, theirs):
                    worst[kind] = max(worst[kind], abs(a[column] - b[column]) / max(b[column], floor))
            name = file.rsplit("/", 1)[-1]
            print(f"{name:32} {worst[0]:9.1e} {worst[1]:9.1e}  {sorted(seconds)[len(seconds) // 2] * 1e6:10.2f} us")


if __name__ == "__main__":
    main()
