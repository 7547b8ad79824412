#!/usr/bin/env python3
"""What a measured BRDF of RGL's format costs in a render, in nacre and in Mitsuba 3 (scalar_rgb).

A ball under even light, two vertices a path, so that every hit draws a direction and asks for its value
and density, and again for the light's direction. The matte ball has all but the BRDF: the difference is
what the BRDF costs. CPU seconds, in turn, loading included.

    PYTHONPATH=... python3 bench/measured_speed.py ../shared/data/brdf/rgl/satin_rosaline_rgb.bsdf
"""
import argparse
import pathlib
import resource
import statistics
import subprocess
import tempfile

import mitsuba

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


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("--nacre", default="build/release/nacre")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--repeats", type=int, default=5)
    o = parser.parse_args()
    materials = {
        "measured": f'<bsdf type="measured"><string name="filename" value="{o.file.resolve()}"/></bsdf>',
        "matte": '<bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>',
    }
    mitsuba.set_variant("scalar_rgb")
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
