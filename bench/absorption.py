#!/usr/bin/env python3
"""Variance times CPU time of `volpath` in media that absorb, one program against another.

    bench/absorption.py nacre-before nacre-now [--boundary glass] [--size 48] [--spp 64] [scene.xml ...]

A ball of a medium is lit by a lamp, in a bright sky or in the dark, for albedos, optical thicknesses (of the diameter)
and phase functions; or the scenes given are rendered as they are. Each is rendered with two seeds by each program,
one after the other. Printed is a table of (variance x CPU time now) / (the same before): below 1 is a gain. Half the
squared difference of the two pictures is the variance. Where light that comes straight through has no noise now and
nothing else is seen, the quotient is 0.
"""
import argparse
import array
import os
import resource
import subprocess
import sys
import tempfile

SCENE = """<scene version="3.0.0"><integrator type="volpath"/>
<sensor type="perspective"><float name="fov" value="24"/><transform name="to_world">
<lookat origin="0,0,6" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm"/></sensor>
<emitter type="constant"><rgb name="radiance" value="{sky}, {sky}, {sky}"/></emitter>
<shape type="sphere"><point name="center" x="3" y="3" z="3"/><emitter type="area"><rgb name="radiance" value="10, 10, 10"/>
</emitter></shape>
<shape type="sphere">{boundary}<medium name="interior" type="homogeneous"><float name="sigma_t" value="{sigma}"/>
<float name="albedo" value="{albedo}"/><phase type="hg"><float name="g" value="{g}"/></phase></medium></shape></scene>"""
BOUNDARIES = {
    "null": '<bsdf type="null"/>',
    "glass": '<bsdf type="dielectric"><float name="int_ior" value="1.4"/><float name="ext_ior" value="1"/></bsdf>',
}


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline(), file.readline()
        order = float(file.readline())
        values = array.array("f", file.read())
    if (order < 0) != (sys.byteorder == "little"):
        values.byteswap()
    return values


def cost(nacre, scene, arguments):
    """Variance of a pixel's mean times CPU seconds."""
    pictures = []
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with tempfile.TemporaryDirectory() as folder:
        for seed in "1", "2":
            out = os.path.join(folder, "out.pfm")
            subprocess.run([nacre, "render", scene, "-o", out, "--quiet", "--seed", seed, *arguments], check=True)
            pictures.append(read_pfm(out))
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return sum((a - b) ** 2 for a, b in zip(*pictures)) / (2 * len(pictures[0])) * seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("now")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--boundary", choices=BOUNDARIES, default="null")
    parser.add_argument("--size", type=int, default=48)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--albedos", type=float, nargs="+", default=[0, 0.03, 0.1, 0.25, 0.45])
    parser.add_argument("--thicknesses", type=float, nargs="+", default=[0.1, 1, 3, 10, 30])
    o = parser.parse_intermixed_args()
    arguments = ["--size", f"{o.size}x{o.size}", "--spp", str(o.spp)]

    def ratio(scene):
        before, now = (cost(program, scene, arguments) for program in (o.before, o.now))
        return f"{now / before:.2g}" if before > 0 else "-"

    for scene in o.scenes:
        print(f"| {scene} | {ratio(scene)} |", flush=True)
    if o.scenes:
        return
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "ball.xml")
        print("| g | sky | albedo |", " | ".join(f"{t:g}" for t in o.thicknesses), "|")
        for g in 0, 0.9:
            for sky in 0.3, 0:
                for albedo in o.albedos:
                    row = []
                    for thickness in o.thicknesses:
                        with open(scene, "w") as file:
                            file.write(SCENE.format(boundary=BOUNDARIES[o.boundary], sky=sky, sigma=thickness / 2,
                                                    albedo=albedo, g=g))
                        row.append(ratio(scene))
                    print(f"| {g:g} | {'bright' if sky else 'dark'} | {albedo:g} |", " | ".join(row), "|", flush=True)


if __name__ == "__main__":
    main()
