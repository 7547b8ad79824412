"""Renders nacre's benchmark scenes with Blender's Cycles, for comparison.

    blender -b --factory-startup -P bench/cycles/render_scene.py -- marble|diffuse|mask \
        --bunny bunny_watertight.obj --out picture.exr [--spp 16] [--size 512] [--seed 0] [--threads 0]

`marble` is the bunny as a smooth dielectric filled with Jensen's marble, simulated completely; `diffuse` is a bunny of
albedo 0.8 with five bounces; `mask` is 1 where the camera sees the bunny and 0 elsewhere. The scene is that of the
Mitsuba files marble_bunny.xml and diffuse_bunny.xml: same lengths (one unit is one millimetre), same camera, light,
environment and floor. The picture is linear RGB, 32-bit floats, uncompressed, without a filter wider than its pixel.
"""
import argparse
import math
import sys
import time

import bpy
from mathutils import Matrix, Vector

# Marble of Jensen et al. 2001, table 1, reduced coefficients, in 1/mm: extinction and albedo in R, G, B.
SIGMA_T = (2.1921, 2.6241, 3.0071)
ALBEDO = (0.999042, 0.998438, 0.997639)
IOR = 1.5
# A walk in marble has hundreds of steps; cutting it short darkens the picture. Cycles allows no more than this.
MAX_BOUNCES = 1024
# Mitsuba's max_depth 6 counts path edges: five scatterings, and Cycles does not count the first.
DIFFUSE_BOUNCES = 4


def parse_arguments():
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="render_scene.py")
    parser.add_argument("scene", choices=("marble", "diffuse", "mask"))
    parser.add_argument("--bunny", required=True, help="the mesh, an OBJ file in millimetres, y up")
    parser.add_argument("--out", required=True, help="the EXR file to write")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    return parser.parse_args(own)


def new_material(name):
    """A material without nodes, its node tree and its output node."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    return material, material.node_tree, nodes.new("ShaderNodeOutputMaterial")


def emitter(name, radiance):
    """Emits `radiance` from its front side; the back is black."""
    material, tree, output = new_material(name)
    emission = tree.nodes.new("ShaderNodeEmission")
    front = tree.nodes.new("ShaderNodeMath")
    front.operation = "MULTIPLY_ADD"  # radiance * (1 - backfacing)
    front.inputs[1].default_value = -radiance
    front.inputs[2].default_value = radiance
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(geometry.outputs["Backfacing"], front.inputs[0])
    tree.links.new(front.outputs["Value"], emission.inputs["Strength"])
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


def diffuse(name, albedo):
    material, tree, output = new_material(name)
    bsdf = tree.nodes.new("ShaderNodeBsdfDiffuse")
    bsdf.inputs["Color"].default_value = (albedo, albedo, albedo, 1)
    tree.links.new(bsdf.outputs["BSDF"], output.inputs["Surface"])
    return material


def marble():
    """Smooth glass around a homogeneous medium with isotropic scattering.

    Cycles' scattering node has coefficient density * colour, its absorption node density * (1 - colour).
    """
    material, tree, output = new_material("marble")
    glass = tree.nodes.new("ShaderNodeBsdfGlass")
    glass.distribution = "SHARP"
    glass.inputs["IOR"].default_value = IOR
    glass.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(glass.outputs["BSDF"], output.inputs["Surface"])

    sigma_s = [t * a for t, a in zip(SIGMA_T, ALBEDO)]
    sigma_a = [t * (1 - a) for t, a in zip(SIGMA_T, ALBEDO)]
    scatter = tree.nodes.new("ShaderNodeVolumeScatter")
    scatter.inputs["Density"].default_value = max(sigma_s)
    scatter.inputs["Color"].default_value = [s / max(sigma_s) for s in sigma_s] + [1]
    scatter.inputs["Anisotropy"].default_value = 0
    absorb = tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorb.inputs["Density"].default_value = max(sigma_a)
    absorb.inputs["Color"].default_value = [1 - a / max(sigma_a) for a in sigma_a] + [1]
    both = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(scatter.outputs["Volume"], both.inputs[0])
    tree.links.new(absorb.outputs["Volume"], both.inputs[1])
    tree.links.new(both.outputs["Shader"], output.inputs["Volume"])
    material.cycles.homogeneous_volume = True
    return material


def add_mesh(name, vertices, faces, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def read_obj(path):
    vertices, faces = [], []
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return vertices, faces


def add_camera(scene):
    origin, target, up = Vector((0, 70, 330)), Vector((0, 48, 0)), Vector((0, 1, 0))
    z = (origin - target).normalized()  # the camera looks along -z
    x = up.cross(z).normalized()
    rotation = Matrix((x, z.cross(x), z)).transposed().to_4x4()
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "HORIZONTAL", math.radians(24)
    data.clip_start, data.clip_end = 1, 1e5
    camera = bpy.data.objects.new("camera", data)
    camera.matrix_world = Matrix.Translation(origin) @ rotation
    scene.collection.objects.link(camera)
    scene.camera = camera


def add_surroundings(scene, lit):
    # A square of 200 mm behind the bunny to the left; the corners are centre +- u +- v, the front is u x v.
    u = Vector((-62.469505, 0.0, 78.086881))
    v = Vector((-41.371440, -84.811452, -33.097152))
    centre = Vector((-250, 250, -200))
    corners = [centre - u - v, centre + u - v, centre + u + v, centre - u + v]
    add_mesh("light", corners, [(0, 1, 2, 3)], emitter("light", 20.0 if lit else 0.0))
    floor = [(-1500, -0.1, 1500), (1500, -0.1, 1500), (1500, -0.1, -1500), (-1500, -0.1, -1500)]
    add_mesh("floor", floor, [(0, 1, 2, 3)], diffuse("floor", 0.5))
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    grey = 0.3 if lit else 0.0
    background.inputs["Color"].default_value = (grey, grey, grey, 1)
    scene.world = world


def set_up_cycles(scene, arguments):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = arguments.spp, arguments.seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = DIFFUSE_BOUNCES if arguments.scene == "diffuse" else MAX_BOUNCES
    for kind in ("diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, kind + "_bounces", cycles.max_bounces)
    # Nothing that trades truth for less noise.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    render = scene.render
    render.resolution_x = render.resolution_y = arguments.size
    render.resolution_percentage = 100
    if arguments.threads:
        render.threads_mode, render.threads = "FIXED", arguments.threads
    image = render.image_settings
    image.file_format, image.color_mode = "OPEN_EXR", "RGB"
    image.color_depth, image.exr_codec = "32", "NONE"
    render.filepath = arguments.out


def main():
    arguments = parse_arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    make = {"marble": marble, "diffuse": lambda: diffuse("bunny", 0.8), "mask": lambda: emitter("bunny", 1.0)}
    add_mesh("bunny", *read_obj(arguments.bunny), make[arguments.scene]())
    add_camera(scene)
    add_surroundings(scene, lit=arguments.scene != "mask")
    set_up_cycles(scene, arguments)
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    print(f"cycles {arguments.scene} spp {arguments.spp} wall_s {time.monotonic() - start:.2f} {arguments.out}")


try:
    main()
except Exception as error:  # Blender would print a trace and exit with 0
    print(f"render_scene.py: {error}", file=sys.stderr)
    sys.exit(1)
