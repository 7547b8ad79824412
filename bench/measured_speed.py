#!/usr/bin/env python3
"""What a measured BRDF of RGL's format costs in a render, in nacre and in Mitsuba 3 (scalar_rgb).

A ball under even light, two vertices a path, so that every hit draws a direction and asks for its value
and density, and again for the light's direction. The matte ball has all but the BRDF: the difference is
what the BRDF costs. CPU seconds, in turn, loading included.

    PYTHONPATH=... python3 bench/measured_speed.py [--calls] ../shared/data/brdf/rgl/satin_rosaline_rgb.bsdf

With --calls by pairs of directions instead, in turn, the best of all turns: bench/measured.cpp's RGL file, and Mitsuba's
single calls from Python less those of a matte BSDF.
"""
import argparse
import json
import pathlib
import random
import resource
import statistics
import subprocess
import tempfile
import time

import mitsuba

from measured_against_mitsuba import direction

SCENE = """<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="2"/></integrator>
<sensor type="perspective"><float name="fov" value="20"/>
<transform name="to_world"><lookat origin="0,-6,0" target="0,0,0" up="0,0,1"/></transform>
<film type="hdrfilm"><integer name="width" value="256"/><integer name="height" value="256"/>
<rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="{spp}"/></sampler></sensor>
<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
<shape type="sphere">{bsdf}</shape></scene>"""


def cpu_of(who, action):
    before = resource.getrusage(who).ru_utime
    action()
    return resource.getrusage(who).ru_utime - before


def mitsuba_calls(path):
    """Seconds a call for values, densities and draws, of the file and of a matte BSDF."""
    context, si = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()
    rng = random.Random(1)
    pairs = [[mitsuba.Vector3f(*direction(rng)) for _ in range(2)] for _ in range(4096)]
    numbers = [mitsuba.Point2f(rng.random(), rng.random()) for _ in pairs]

    def seconds(bsdf, call):
        begin = time.perf_counter()
        for (light, viewer), u in zip(pairs, numbers):
            si.wi = viewer
            call(bsdf, light, u)
        return (time.perf_counter() - begin) / len(pairs)

    calls = {"values": lambda b, light, u: b.eval(context, si, light),
             "densities": lambda b, light, u: b.pdf(context, si, light),
             "draws, weighed": lambda b, light, u: b.sample(context, si, 0.5, u)}
    measured = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    matte = mitsuba.load_dict({"type": "diffuse"})
    return {name: (seconds(measured, call), seconds(matte, call)) for name, call in calls.items()}


def by_calls(o):
    best = {}
    for _ in range(o.repeats):
        text = subprocess.run([o.bench, "--benchmark_filter=/1", "--benchmark_format=json",
                               "--benchmark_min_time=0.2"], check=True, capture_output=True, text=True).stdout
        found = {f"nacre, {row['name'][:-2]}": (1 / row["items_per_second"], 0.0)
                 for row in json.loads(text)["benchmarks"]}
        found.update((f"Mitsuba, {name}", both) for name, both in mitsuba_calls(o.file).items())
        for name, both in found.items():
            best[name] = [min(pair) for pair in zip(both, best.get(name, both))]
    for name, (measured, matte) in best.items():
        print(f"{name:24} {1e-6 / (measured - matte):8.2f} M/s")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--nacre", default="build/release/nacre")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--calls", action="store_true")
    parser.add_argument("--bench", default="build/bench/bench/bench_measured")
    o = parser.parse_args()
    mitsuba.set_variant("scalar_rgb")
    if o.calls:
        return by_calls(o)
    materials = {
        "measured": f'<bsdf type="measured"><string name="filename" value="{o.file.resolve()}"/></bsdf>',
        "matte": '<bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>',
    }
    seconds = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(o.repeats):
            for name, bsdf in materials.items():
                scene = pathlib.Path(folder) / f"{name}.xml"
                scene.write_text(SCENE.format(bsdf=bsdf, spp=o.spp))
                command = [o.nacre, "render", scene, "-o", f"{folder}/out.exr", "--quiet"]
                seconds.setdefault(("nacre", name), []).append(
                    cpu_of(resource.RUSAGE_CHILDREN, lambda: subprocess.run(command, check=True)))
                seconds.setdefault(("mitsuba", name), []).append(
                    cpu_of(resource.RUSAGE_SELF, lambda: mitsuba.render(mitsuba.load_file(str(scene)))))
    median = {key: statistics.median(values) for key, values in seconds.items()}
    print("          measured   matte   difference")
    for program in ("nacre", "mitsuba"):
        a, b = median[program, "measured"], median[program, "matte"]
        print(f"{program:8} {a:9.2f} {b:8.2f} {a - b:10.2f}")


if __name__ == "__main__":
    main()
