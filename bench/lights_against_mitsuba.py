#!/usr/bin/env python3
"""Balls of scattering matter under lights of several kinds, in nacre's volpath and in Mitsuba 3's.

    PYTHONPATH=... bench/lights_against_mitsuba.py [--nacre build/release/nacre] [--env studio.hdr] [names]

needs the Python packages mitsuba and numpy. Each scene is rendered twice by both. Means over blocks of 16 x 16 pixels are
compared; their standard errors come from the differences of the two pictures. `z` is the difference over its standard
error: about 1 in the root mean square where both estimate the same. Lights without extent are compared behind a
boundary without refraction only: through a refracting one Mitsuba does not find them."""
import argparse
import pathlib
import subprocess
import tempfile
import time

import mitsuba as mi
import numpy as np

SIZE, BLOCK = 48, 16

SCENE = """<scene version="3.0.0">
<integrator type="volpath"><integer name="max_depth" value="60"/><integer name="rr_depth" value="1000"/></integrator>
<sensor type="perspective"><float name="fov" value="30"/>
<transform name="to_world"><lookat origin="0, -5, 1.5" target="0, 0, 0" up="0, 0, 1"/></transform>
<film type="hdrfilm"><integer name="width" value="48"/><integer name="height" value="48"/><rfilter type="box"/></film>
<sampler type="independent"><integer name="sample_count" value="16"/></sampler></sensor>
<shape type="sphere">{boundary}<medium name="interior" type="homogeneous"><float name="sigma_t" value="3"/>
<rgb name="albedo" value="0.95, 0.8, 0.5"/><phase type="hg"><float name="g" value="0.4"/></phase></medium></shape>
<shape type="rectangle"><transform name="to_world"><scale value="4"/><translate z="-1.2"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="0.5, 0.4, 0.3"/></bsdf></shape>
{light}</scene>"""
INDEX = '<float name="int_ior" value="1.4"/><float name="ext_ior" value="1"/></bsdf>'
BOUNDARIES = {
    "null": '<bsdf type="null"/>',
    "glass": '<bsdf type="dielectric">' + INDEX,
    "rough": '<bsdf type="roughdielectric"><string name="distribution" value="ggx"/>'
             '<float name="alpha" value="0.2"/>' + INDEX}
LIGHTS = {
    "point": '<emitter type="point"><point name="position" x="2" y="-2" z="3"/>'
             '<rgb name="intensity" value="20, 18, 15"/></emitter>',
    "sun": '<emitter type="directional"><vector name="direction" value="-0.5, 0.6, -1"/>'
           '<rgb name="irradiance" value="2, 2, 2"/></emitter>',
    "lamp": '<shape type="sphere"><point name="center" x="2" y="-2" z="3"/><float name="radius" value="0.8"/>'
            '<emitter type="area"><rgb name="radiance" value="10, 9, 8"/></emitter></shape>',
    "sky": '<emitter type="envmap"><string name="filename" value="{env}"/>'
           '<transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>'}
# Samples of Mitsuba and of nacre.
SCENES = {"point_null": (512, 1024), "sun_null": (512, 1024), "lamp_glass": (2048, 512), "lamp_rough": (2048, 512),
          "sky_glass": (4096, 512)}


def read_pfm(path):
    raw = path.read_bytes().split(b"\n", 3)
    width, height = map(int, raw[1].split())
    return np.frombuffer(raw[3], dtype="<f4").reshape(height, width, 3)[::-1]


def blocks(picture):
    n = SIZE // BLOCK
    return picture.reshape(n, BLOCK, n, BLOCK, 3).mean((1, 3))


def mean_and_error(a, b):
    return (blocks(a) + blocks(b)) / 2, np.sqrt(blocks((a - b) ** 2) / 4 / BLOCK ** 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*", default=list(SCENES))
    parser.add_argument("--nacre", default="build/release/nacre")
    parser.add_argument("--env", default="../shared/data/env/studio_small_03_1k.hdr")
    o = parser.parse_args()
    mi.set_variant("scalar_rgb")
    print(f"{'scene':12} {'nacre / Mitsuba, r g b':24} {'z rms':>6} {'largest':>8} {'seconds: Mitsuba, nacre':>24}")
    with tempfile.TemporaryDirectory() as folder:
        for name in o.names:
            light, boundary = name.split("_")
            file = pathlib.Path(folder) / f"{name}.xml"
            file.write_text(SCENE.format(boundary=BOUNDARIES[boundary],
                                         light=LIGHTS[light].format(env=pathlib.Path(o.env).resolve())))
            scene, (theirs, ours) = mi.load_file(str(file)), SCENES[name]
            begin = time.time()
            m, m_error = mean_and_error(*(np.array(mi.render(scene, spp=theirs, seed=s))[..., :3] for s in (1, 2)))
            middle = time.time()
            pictures = []
            for seed in (1, 2):
                out = file.with_suffix(f".{seed}.pfm")
                subprocess.run([o.nacre, "render", file, "--spp", str(ours), "--seed", str(seed), "-o", out,
                                "--quiet"], check=True, capture_output=True)
                pictures.append(read_pfm(out))
            n, n_error = mean_and_error(*pictures)
            z = (n - m) / np.sqrt(m_error ** 2 + n_error ** 2)
            ratio = " ".join(f"{r:.4f}" for r in n.mean((0, 1)) / m.mean((0, 1)))
            print(f"{name:12} {ratio:24} {np.sqrt((z ** 2).mean()):6.2f} {np.abs(z).max():8.2f} "
                  f"{middle - begin:15.0f} {time.time() - middle:8.0f}", flush=True)


if __name__ == "__main__":
    main()
