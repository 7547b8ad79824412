#include "nacre/peers/cycles_job.h"

namespace nacre {

std::string_view cycles_job() {
    return R"PYTHON("""Renders with Blender's Cycles what scene.json beside this file describes.

    blender -b --factory-startup -P cycles.py -- scene.json

World coordinates, lengths and radiances are those of nacre. The picture is linear RGB, 32-bit floats.

  film         width, height, crop [x, y, width, height], filter [type, width], output
  camera       type, to_world (rows of 4; looks along -z, y up), sensor_width at distance 1, shift, clip,
               aperture_radius, focus_distance
  render       samples, seed, threads, max_bounces
  meshes       file of arrays (positions, triangles, normals, uvs), counts, shader, volume
  lights       point, spot, sun
  environment  radiance, or image in Blender's equirectangular mapping
  shader       a tree of closures; colours are triples or baked images over the mesh's uv
"""
import array
import json
import math
import os
import sys
import time
import traceback

import bpy
from mathutils import Matrix, Vector

FOLDER = os.path.dirname(os.path.abspath(__file__))


class Tree:
    """Makes the nodes of a shader tree; a shader is an output socket, black is None."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def node(self, kind, **inputs):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            self.set(node.inputs[name.replace("_", " ")], value)
        return node

    def set(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        elif socket.type == "RGBA":
            socket.default_value = list(value) + [1]
        elif value is not None and socket.type != "SHADER":
            socket.default_value = value

    def math(self, operation, *values):
        node = self.tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, values):
            self.set(socket, value)
        return node.outputs[0]

    def value(self, spec):
        """A number, a colour, or a socket that varies."""
        if not isinstance(spec, dict):
            return spec
        if "image" in spec:
            node = self.node("TexImage")
            node.image = load_image(spec["image"])
            node.extension = "EXTEND"
            return node.outputs["Color"]
        backfacing = self.node("NewGeometry").outputs["Backfacing"]
        if "backfacing" in spec:
            return backfacing
        if "fresnel" in spec:
            return self.node("Fresnel", IOR=spec["fresnel"]).outputs["Fac"]
        # A pane has the same index behind it as in front: Fresnel's node would turn it over.
        ior = spec["thin_fresnel"]
        turned = self.math("MULTIPLY_ADD", backfacing, 1 / ior - ior, ior)
        once = self.node("Fresnel", IOR=turned).outputs["Fac"]
        return self.math("DIVIDE", self.math("MULTIPLY", once, 2.0), self.math("ADD", once, 1.0))

    def shader(self, spec):
        if spec is None:
            return None
        return getattr(self, spec["type"])(spec)

    def diffuse(self, spec):
        return self.node("BsdfDiffuse", Color=self.value(spec["color"])).outputs[0]

    def transparent(self, spec):
        return self.node("BsdfTransparent", Color=self.value(spec["color"])).outputs[0]

    def emission(self, spec):
        return self.node("Emission", Color=self.value(spec["color"]), Strength=spec["strength"]).outputs[0]

    def microfacets(self, spec, kind, **inputs):
        node = self.node(kind, Color=self.value(spec["color"]), **inputs)
        node.distribution = spec["distribution"]
        if spec["distribution"] != "SHARP":
            self.set(node.inputs["Roughness"], spec["roughness"])
        return node.outputs[0]

    def glass(self, spec):
        return self.microfacets(spec, "BsdfGlass", IOR=spec["ior"])

    def glossy(self, spec):
        return self.microfacets(spec, "BsdfGlossy")

    def subsurface(self, spec):
        node = self.node("BsdfPrincipled", Base_Color=spec["color"], Subsurface=1.0, Subsurface_Color=spec["color"],
                         Subsurface_Radius=spec["radius"], Subsurface_IOR=spec["ior"],
                         Subsurface_Anisotropy=spec["anisotropy"], Specular=spec["specular"], Roughness=0.0)
        node.subsurface_method = "RANDOM_WALK"
        return node.outputs[0]

    def mix(self, spec):
        node = self.node("MixShader")
        self.set(node.inputs[0], self.value(spec["factor"]))
        for socket, key in ((node.inputs[1], "a"), (node.inputs[2], "b")):
            self.set(socket, self.shader(spec[key]))
        return node.outputs[0]

    def add(self, spec):
        node = self.node("AddShader")
        self.set(node.inputs[0], self.shader(spec["a"]))
        self.set(node.inputs[1], self.shader(spec["b"]))
        return node.outputs[0]

    def volume(self, spec):
        """Coefficients by channel: density * colour scatters, density * (1 - colour) is absorbed."""
        node = self.node("AddShader")
        scattering, absorption = spec["sigma_s"], spec["sigma_a"]
        if max(scattering) > 0:
            density = max(scattering)
            scatter = self.node("VolumeScatter", Density=density, Anisotropy=spec["anisotropy"],
                                Color=[s / density for s in scattering])
            self.set(node.inputs[0], scatter.outputs[0])
        if max(absorption) > 0:
            density = max(absorption)
            absorb = self.node("VolumeAbsorption", Density=density, Color=[1 - a / density for a in absorption])
            self.set(node.inputs[1], absorb.outputs[0])
        return node.outputs[0]


def load_image(name):
    image = bpy.data.images.load(os.path.join(FOLDER, name), check_existing=True)
    image.colorspace_settings.name = "Non-Color"  # linear numbers, to be taken as they are
    return image


def link(scene, name, data):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    return thing


def make_material(spec):
    material = bpy.data.materials.new(spec["name"])
    material.use_nodes = True
    tree = Tree(material.node_tree)
    output = tree.node("OutputMaterial")
    tree.set(output.inputs["Surface"], tree.shader(spec["shader"]))
    if spec.get("volume"):
        tree.set(output.inputs["Volume"], tree.volume(spec["volume"]))
        material.cycles.homogeneous_volume = True
    return material


def add_mesh(scene, spec):
    vertices, triangles = spec["vertices"], spec["triangles"]
    with open(os.path.join(FOLDER, spec["file"]), "rb") as file:
        def read(kind, count):
            values = array.array(kind)
            values.fromfile(file, count)
            return values

        positions, corners = read("f", 3 * vertices), read("i", 3 * triangles)
        normals = read("f", 3 * vertices) if spec["normals"] else None
        uvs = read("f", 2 * vertices) if spec["uvs"] else None
    mesh = bpy.data.meshes.new(spec["name"])
    mesh.vertices.add(vertices)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(3 * triangles)
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(triangles)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, 3 * triangles, 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * triangles)
    mesh.polygons.foreach_set("use_smooth", [normals is not None] * triangles)
    if uvs is not None:
        layer = mesh.uv_layers.new(name="uv")
        layer.data.foreach_set("uv", array.array("f", (x for i in corners for x in uvs[2 * i:2 * i + 2])))
    mesh.update(calc_edges=True)
    if normals is not None:
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(list(zip(normals[0::3], normals[1::3], normals[2::3])))
    mesh.materials.append(make_material(spec))
    link(scene, spec["name"], mesh)


def add_light(scene, spec):
    kind = spec["type"]
    data = bpy.data.lights.new(kind, "SUN" if kind == "sun" else "POINT")
    data.use_nodes = True
    tree = Tree(data.node_tree)
    output = tree.node("OutputLight")
    emission = tree.node("Emission", Color=spec["color"])
    tree.set(output.inputs["Surface"], emission.outputs[0])
    strength = spec["strength"]
    light = link(scene, kind, data)
    data.energy = 1.0
    if kind == "sun":
        data.angle = 0.0
        # A sun shines along its -z.
        light.rotation_mode = "QUATERNION"
        light.rotation_quaternion = Vector(spec["direction"]).to_track_quat("-Z", "Y")
    else:
        data.shadow_soft_size = 0.0
        light.location = spec["position"]
        strength *= 4 * math.pi  # the power of that intensity
    if kind == "spot":
        # Seen from the lit point, the light's Incoming points to it.
        incoming = tree.node("NewGeometry").outputs["Incoming"]
        cosine = tree.node("VectorMath")
        cosine.operation = "DOT_PRODUCT"
        tree.set(cosine.inputs[0], incoming)
        tree.set(cosine.inputs[1], spec["direction"])
        angle = tree.math("ARCCOSINE", cosine.outputs["Value"])
        fall = tree.node("MapRange")
        fall.clamp = True
        for socket, value in zip(fall.inputs[1:5], (spec["beam"], spec["cutoff"], strength, 0.0)):
            tree.set(socket, value)
        tree.set(fall.inputs[0], angle)
        strength = fall.outputs[0]
    tree.set(emission.inputs["Strength"], strength)


def set_environment(scene, spec):
    world = bpy.data.worlds.new("world")
    scene.world = world
    world.use_nodes = True
    tree = Tree(world.node_tree)
    output = tree.node("OutputWorld")
    background = tree.node("Background", Color=spec.get("color", (0, 0, 0)), Strength=spec.get("strength", 0.0))
    tree.set(output.inputs["Surface"], background.outputs[0])
    if "image" in spec:
        image = tree.node("TexEnvironment")
        image.image = load_image(spec["image"])
        tree.set(background.inputs["Color"], image.outputs["Color"])


def add_camera(scene, spec):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.sensor_width = "HORIZONTAL", 36.0
    if spec["type"] == "orthographic":
        data.type = "ORTHO"
        data.ortho_scale = spec["width"]
    else:
        data.lens = 36.0 / spec["width"]
    data.shift_x, data.shift_y = spec["shift"]
    data.clip_start, data.clip_end = spec["clip"]
    if spec["aperture_radius"] > 0:
        data.dof.use_dof = True
        data.dof.focus_distance = spec["focus_distance"]
        data.dof.aperture_fstop = 1e-3 * data.lens / (2 * spec["aperture_radius"])
    camera = link(scene, "camera", data)
    rows = spec["to_world"]
    camera.matrix_world = Matrix([rows[i:i + 4] for i in range(0, 16, 4)])
    scene.camera = camera


def set_up(scene, film, spec):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = spec["samples"], spec["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.time_limit = 0
    cycles.max_bounces = spec["max_bounces"]
    for kind in ("diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, kind + "_bounces", spec["max_bounces"])
    cycles.transparent_max_bounces = 1024
    # Nothing that trades truth for less noise.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.film_exposure = 1.0
    cycles.pixel_filter_type, cycles.filter_width = film["filter"]
    render = scene.render
    render.resolution_x, render.resolution_y = film["width"], film["height"]
    render.resolution_percentage = 100
    x, y, width, height = film["crop"]
    render.use_border = render.use_crop_to_border = [x, y, width, height] != [0, 0, film["width"], film["height"]]
    render.border_min_x, render.border_max_x = x / film["width"], (x + width) / film["width"]
    render.border_min_y, render.border_max_y = 1 - (y + height) / film["height"], 1 - y / film["height"]
    if spec["threads"]:
        render.threads_mode, render.threads = "FIXED", spec["threads"]
    scene.view_settings.view_transform = "Raw"
    image = render.image_settings
    image.file_format, image.color_mode = "OPEN_EXR", "RGB"
    image.color_depth, image.exr_codec = "32", "NONE"
    render.use_file_extension = False
    render.filepath = os.path.join(FOLDER, film["output"])


def main():
    with open(os.path.join(FOLDER, sys.argv[sys.argv.index("--") + 1]), encoding="utf-8") as file:
        job = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    for mesh in job["meshes"]:
        add_mesh(scene, mesh)
    for light in job["lights"]:
        add_light(scene, light)
    set_environment(scene, job["environment"])
    add_camera(scene, job["camera"])
    set_up(scene, job["film"], job["render"])
    start = time.monotonic()
    bpy.ops.render.render(write_still=True)
    print(f"nacre: version {bpy.app.version_string}")
    print(f"nacre: samples {scene.cycles.samples} seed {scene.cycles.seed}")
    print(f"nacre: seconds {time.monotonic() - start:.3f}", flush=True)


try:
    main()
except Exception:  # Blender itself would exit with 0
    traceback.print_exc()
    sys.stderr.flush()
    os._exit(1)
)PYTHON";
}

}  // namespace nacre
