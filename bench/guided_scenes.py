#!/usr/bin/env python3
"""Writes small scenes of the kinds that guided exits meet (docs/benchmarks.md), for bench/noise.py.

    bench/guided_scenes.py folder
    bench/noise.py folder/*.xml --run nacre --run "nacre --no-guided-exits" --spp 64

A ball of scattering matter behind a boundary of index 1.5, lit from behind and above, 64 x 64 pixels.
"""
import os
import struct
import sys

SCENE = """<scene version="3.0.0"><integrator type="volpath"/>
<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world">
<lookat origin="0,1,7" target="0,0,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="64"/></film></sensor>
{body}</scene>"""
GLASS = '<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>'
NULL = '<bsdf type="null"/>'
ROUGH = ('<bsdf type="roughdielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>{}</bsdf>')
EVEN = ROUGH.format('<float name="alpha" value="0.2"/>')
TEXTURED = ROUGH.format('<texture type="checkerboard" name="alpha"><float name="color0" value="0.1"/>'
                        '<float name="color1" value="0.3"/><transform name="to_uv"><scale x="8" y="8"/></transform>'
                        "</texture>")
INSIDE = '<float name="sigma_t" value="{}"/><float name="albedo" value="0.95"/>'
MARBLE = '<medium type="homogeneous" id="marble">' + INSIDE.format(10) + "</medium>"
USED = '<ref name="interior" id="marble"/>'
CLOUD = ('<medium name="interior" type="heterogeneous"><volume type="gridvolume" name="sigma_t"><string name="filename" '
         'value="cloud.vol"/><transform name="to_world"><scale value="2"/><translate x="-1" y="-1" z="-1"/></transform>'
         '</volume><float name="albedo" value="0.95"/><float name="scale" value="10"/></medium>')
HAZE = '<medium type="homogeneous" id="haze">' + INSIDE.format(0.05) + "</medium>"


def ball(inside, x=0., y=0., z=0., radius=1.):
    return (f'<shape type="sphere"><point name="center" x="{x}" y="{y}" z="{z}"/><float name="radius" value="{radius}"/>'
            f"{inside}</shape>")


def medium(sigma, side="interior"):
    return f'<medium name="{side}" type="homogeneous">{INSIDE.format(sigma)}</medium>'


def shines(radiance):
    return f'<emitter type="area"><rgb name="radiance" value="{radiance}, {radiance}, {radiance}"/></emitter>'


def square(place, half, radiance, turn=""):
    return (f'<shape type="rectangle"><transform name="to_world"><scale value="{half}"/>{turn}<translate value="{place}"/>'
            f"</transform>{shines(radiance)}</shape>")


LAMP = ball(shines(60), 3, 4, -2, 0.4)
SKY = '<emitter type="envmap"><string name="filename" value="window.pfm"/></emitter>'
POINT = ('<emitter type="point"><point name="position" x="3" y="4" z="-2"/><rgb name="intensity" value="30, 30, 30"/>'
         "</emitter>")
TWO = MARBLE + ball(GLASS + USED, -1.2)
KINDS = {
    "plain": (22, ball(GLASS + medium(10)) + LAMP),
    "rough": (22, ball(EVEN + medium(10)) + LAMP),
    "lamp_between": (38, TWO + ball(GLASS + USED, 1.2) + ball(shines(60), 0, 0.8, -0.6, 0.2)),
    "null_beside": (38, TWO + ball(NULL + USED, 1.2) + LAMP),
    "rough_beside": (38, TWO + ball(EVEN + USED, 1.2) + LAMP),
    "lamp_in_box": (22, ball(GLASS + medium(10)) + square("0.9, 0.9, 0", 0.25, 60,
                                                          '<rotate x="1" angle="90"/><rotate z="1" angle="-45"/>')),
    "lamp_inside": (22, ball(GLASS + medium(10)) + ball(shines(5), 0, -0.4, 0, 0.2) + LAMP),
    "textured": (22, ball(TEXTURED + medium(10)) + LAMP),
    "cloud": (22, ball(GLASS + CLOUD) + LAMP),
    "cloud_rough": (22, ball(EVEN + CLOUD) + LAMP),
    "cloud_sky": (22, ball(GLASS + CLOUD) + SKY),
    "cloud_point": (22, ball(GLASS + CLOUD) + POINT),
    "inclusion": (22, MARBLE + ball(GLASS + USED) + ball(GLASS + medium(20) + USED.replace("interior", "exterior"),
                                                         0.3, 0.3, 0.2, 0.4) + LAMP),
    "inclusion_point": (22, MARBLE + ball(GLASS + USED) + ball(
        GLASS + medium(20) + USED.replace("interior", "exterior"), 0.3, 0.3, 0.2, 0.4) + POINT),
    "haze": (22, HAZE + ball(NULL + '<ref name="interior" id="haze"/>', radius=6) + ball(
        GLASS + medium(10) + '<ref name="exterior" id="haze"/>') + LAMP),
}


def write_cloud(path, n=24):
    """Extinction as Mitsuba's .vol: denser and thinner blobs, between 0.1 and 1."""
    with open(path, "wb") as file:
        file.write(b"VOL\3" + struct.pack("<5i6f", 1, n, n, n, 1, 0, 0, 0, 1, 1, 1))
        for z in range(n):
            for y in range(n):
                for x in range(n):
                    thin = (x // 4 + y // 4 + z // 4) % 2
                    file.write(struct.pack("<f", 0.1 if thin else 1.0))


def write_window(path):
    """An even sky with a bright window behind and above."""
    with open(path, "wb") as file:
        file.write(b"PF\n128 64\n-1\n")
        for y in reversed(range(64)):
            for x in range(128):
                value = 60.0 if 8 <= x < 15 and 16 <= y < 22 else 0.2
                file.write(struct.pack("<3f", value, value, value))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    write_cloud(os.path.join(folder, "cloud.vol"))
    write_window(os.path.join(folder, "window.pfm"))
    for name, (fov, body) in KINDS.items():
        with open(os.path.join(folder, name + ".xml"), "w") as file:
            file.write(SCENE.format(fov=fov, body=body))


if __name__ == "__main__":
    main()
