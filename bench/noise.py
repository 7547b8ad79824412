#!/usr/bin/env python3
"""Noise that a second of CPU time leaves: variance times CPU time of programs, or of settings of one, by region.

    bench/noise.py scene.xml --run nacre-before --run nacre-now
    bench/noise.py scene.xml --run build/release/nacre --run "build/release/nacre --no-guided-exits" --spp 32 --seeds 4

Each --run is a program and options for its verb `render`. The scene is rendered with several seeds by each, by turns,
so that what else the machine does falls on all alike. A row for each run has its CPU seconds a picture (precomputation
in it), the mean, the variance of a picture over the squared mean, and that times the CPU seconds over the same of the
last run, below 1 being less noise for the time: of all pixels, without the noisiest 2 % of each run, and of the darkest
and the brightest fifth (by the mean of all pictures). Pixels without noise in any run, such as the background, do not
count. With n seeds the variance of a picture without outliers is known to about sqrt(2 / (n - 1) / pixels); fireflies
make it less certain, and the column without them says how much they matter.
"""
import argparse
import os
import resource
import shlex
import subprocess
import sys
import tempfile

from absorption import read_pfm

TRIM = 0.02


def luminance(path):
    values = read_pfm(path)
    return [0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in zip(values[0::3], values[1::3], values[2::3])]


def render(run, scene, out, arguments):
    """Luminance of the picture, and CPU seconds."""
    program, *options = shlex.split(run)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "render", scene, "-o", out, "--quiet", *options, *arguments], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return luminance(out), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def moments(pictures):
    """Mean and variance of each pixel over the pictures."""
    n = len(pictures)
    means = [sum(values) / n for values in zip(*pictures)]
    return means, [sum((v - mean) ** 2 for v in values) / (n - 1) for mean, values in zip(means, zip(*pictures))]


def regions(means, variances):
    """Pixels that count: all, and the darkest and brightest fifth."""
    noisy = [i for i in range(len(means[0])) if any(v[i] > 0 for v in variances)]
    noisy.sort(key=lambda i: sum(mean[i] for mean in means))
    fifth = max(1, len(noisy) // 5)
    return noisy, noisy[:fifth], noisy[-fifth:]


def compare(runs, scene, arguments, seeds):
    """Rows of the table, in the order of the runs."""
    pictures, seconds = [[] for _ in runs], [0.0] * len(runs)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.pfm")
        for seed in range(1, seeds + 1):
            for k, run in enumerate(runs):
                picture, time = render(run, scene, out, [*arguments, "--seed", str(seed)])
                pictures[k].append(picture)
                seconds[k] += time / seeds
    means, variances = zip(*map(moments, pictures))
    all_, dark, bright = regions(means, variances)
    if not all_:
        sys.exit(f"noise.py: {scene}: no pixel has noise")

    def average(values, pixels):
        return sum(values[i] for i in pixels) / len(pixels)

    def trimmed(values):
        kept = sorted(values[i] for i in all_)[:len(all_) - int(len(all_) * TRIM)]
        return sum(kept) / len(kept)

    costs = [[time * v for v in (average(values, all_), trimmed(values), average(values, dark), average(values, bright))]
             for time, values in zip(seconds, variances)]
    for k, run in enumerate(runs):
        mean = average(means[k], all_)
        ratios = (f"{a / b:.3g}" if b > 0 else "-" for a, b in zip(costs[k], costs[-1]))
        yield [os.path.splitext(os.path.basename(scene))[0], run, f"{seconds[k]:.2f}", f"{mean:.4f}",
               f"{average(variances[k], all_) / mean**2:.3g}", *ratios]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", metavar="scene.xml")
    parser.add_argument("--run", action="append", required=True, dest="runs", metavar="PROGRAM [OPTIONS]")
    parser.add_argument("--size", help="WIDTHxHEIGHT")
    parser.add_argument("--crop", help="x,y,width,height of what is looked at")
    parser.add_argument("--spp", type=int)
    parser.add_argument("--seeds", type=int, default=3)
    o = parser.parse_args()
    if o.seeds < 2:
        parser.error("--seeds: variance needs at least two pictures")
    arguments = [part for name in ("size", "crop", "spp") if (value := getattr(o, name))
                 for part in ("--" + name, str(value))]
    print("| scene | run | CPU s | mean | variance | variance x CPU | trimmed | darkest fifth | brightest |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in o.scenes:
        for row in compare(o.runs, scene, arguments, o.seeds):
            print("|", " | ".join(row), "|", flush=True)


if __name__ == "__main__":
    main()
