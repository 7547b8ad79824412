#!/usr/bin/env python3
"""Renders bound by reflectance: two builds of nacre against each other.

    bench/materials.py BEFORE AFTER [--spp 16] [--repeats 3] [--mode rgb] [--only MATERIAL ...]

A sphere on a floor, both of one material, under a constant light and an area light, by path tracing on one thread. Prints for
each material the medians of the user seconds, start-up (a picture of one pixel) taken off, their ratio, and the largest
relative difference of a value of the two pictures. The runs alternate.
"""
import argparse
import array
import pathlib
import resource
import statistics
import subprocess
import tempfile


def numbers(name, low, high):
    return f'<texture type="checkerboard" name="{name}"><float name="color0" value="{low}"/>' \
           f'<float name="color1" value="{high}"/>{TILES}</texture>'


def colours(name, one, other):
    return f'<texture type="checkerboard" name="{name}"><rgb name="color0" value="{one}"/>' \
           f'<rgb name="color1" value="{other}"/>{TILES}</texture>'


TILES = '<transform name="to_uv"><scale x="8" y="8"/></transform>'
RED, BLUE = "0.6 0.3 0.1", "0.1 0.3 0.6"
GGX = '<string name="fresnel" value="schlick"/><float name="f0" value="0.7"/>'
COMPENSATED = '<string name="compensation" value="kulla_conty"/>' + GGX
MATERIALS = {
    "lambert": '<bsdf type="lambert"/>',
    "ggx": f'<bsdf type="ggx">{GGX}<float name="alpha" value="0.4"/></bsdf>',
    "ggx, textured": f'<bsdf type="ggx">{GGX}{numbers("alpha", 0.2, 0.6)}{colours("ks", RED, BLUE)}</bsdf>',
    "ggx, compensated": f'<bsdf type="ggx">{COMPENSATED}<float name="alpha" value="0.5"/></bsdf>',
    "ggx, compensated, textured": f'<bsdf type="ggx">{COMPENSATED}{numbers("alpha", 0.2, 0.6)}</bsdf>',
    "ward, textured": f'<bsdf type="ward">{numbers("alpha", 0.2, 0.6)}{colours("kd", RED, BLUE)}</bsdf>',
    "oren_nayar, textured":
        f'<bsdf type="oren_nayar">{numbers("sigma", 0.1, 0.5)}{colours("reflectance", RED, BLUE)}</bsdf>',
    "metallic_roughness, textured":
        f'<bsdf type="metallic_roughness">{numbers("roughness", 0.3, 0.7)}{colours("base_color", RED, BLUE)}</bsdf>',
    "cook_torrance": '<bsdf type="cook_torrance"/>',
    "roughconductor":
        '<bsdf type="roughconductor"><string name="material" value="Cu"/><float name="alpha" value="0.3"/></bsdf>',
}
SCENE = """<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="8"/></integrator>
<sensor type="perspective"><float name="fov" value="35"/>
<transform name="to_world"><lookat origin="0,2.2,6" target="0,0.8,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="120"/></film></sensor>
<emitter type="constant"><rgb name="radiance" value="0.4 0.5 0.6"/></emitter>
<shape type="rectangle"><transform name="to_world"><scale value="0.7"/><rotate x="1" angle="90"/>
<translate x="1.5" y="4" z="1"/></transform>
<emitter type="area"><rgb name="radiance" value="12 10 8"/></emitter></shape>
<shape type="sphere"><point name="center" x="0" y="1" z="0"/>{material}</shape>
<shape type="rectangle"><transform name="to_world"><scale value="6"/><rotate x="1" angle="-90"/></transform>{material}</shape>
</scene>
"""


def render(nacre, scene, options, picture, size=None):
    """User seconds of one render."""
    command = [nacre, "render", scene, "-t", "1", "--quiet", "-o", picture, *options]
    if size:
        command += ["--size", size]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def values(picture):
    """The numbers of a PFM."""
    data = pathlib.Path(picture).read_bytes()
    for _ in range(3):
        data = data[data.index(b"\n") + 1:]
    return array.array("f", data)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--only", nargs="+", default=list(MATERIALS), choices=MATERIALS, metavar="MATERIAL")
    parser.add_argument("--spp", default="16")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--mode", default="rgb", choices=["rgb", "spectral"])
    args = parser.parse_args()
    options = ["--spp", args.spp, "--mode", args.mode]
    print(f"{'':30} {'before':>8} {'after':>8} {'ratio':>6} {'difference':>11}")
    with tempfile.TemporaryDirectory() as folder:
        for name in args.only:
            scene = pathlib.Path(folder, "scene.xml")
            scene.write_text(SCENE.format(material=MATERIALS[name]))
            pictures = [str(pathlib.Path(folder, f"{i}.pfm")) for i in range(2)]
            programs = [args.before, args.after]
            starts = [min(render(p, scene, options, pictures[i], "1x1") for _ in range(2)) for i, p in enumerate(programs)]
            seconds = [[], []]
            for _ in range(args.repeats):
                for i, program in enumerate(programs):
                    seconds[i].append(render(program, scene, options, pictures[i]))
            before, after = (statistics.median(s) - start for s, start in zip(seconds, starts))
            largest = max(abs(a - b) / max(abs(a), abs(b), 1e-6) for a, b in zip(*map(values, pictures)))
            print(f"{name:30} {before:8.2f} {after:8.2f} {before / after:6.2f} {largest:11.1e}", flush=True)


if __name__ == "__main__":
    main()
