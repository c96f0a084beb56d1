"""The display SCENE in Blender's Cycles. One Blender unit is a millimetre."""
import argparse
import math
import os
import sys

import bpy
import numpy as np
from mathutils import Matrix

HERE = os.path.dirname(os.path.abspath(__file__))


def arguments():
    parser = argparse.ArgumentParser(prog="scene.py")
    parser.add_argument("-o", "--output", default="view.exr", help="picture to write: .exr")
    parser.add_argument("--samples", type=int, default=SCENE["samples"], help="rays per pixel")
    parser.add_argument("--size", default="x".join(map(str, SCENE["camera"]["size"])), help="pixels of the frame: WxH")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


# shared.py


class Nodes:
    """The nodes of a new material."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.tree.nodes.clear()

    def add(self, kind, inputs=(), **settings):
        """A node; inputs are (name or number, value or socket)."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for key, value in settings.items():
            setattr(node, key, value)
        for key, value in inputs:
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[key])
            else:
                node.inputs[key].default_value = value
        return node

    def math(self, operation, a, b=0.0, c=0.0):
        return self.add("Math", ((0, a), (1, b), (2, c)), operation=operation).outputs[0]

    def done(self, shader):
        self.add("OutputMaterial", (("Surface", shader),))
        return self.material


def black(name):
    nodes = Nodes(name)
    return nodes.done(nodes.add("BsdfDiffuse", (("Color", (0, 0, 0, 1)),)).outputs[0])


def glass(name, ratio, reflects):
    """Refraction only, weighted by Fresnel's equations if the display asks for them; total reflection where light continues after it."""
    nodes = Nodes(name)
    color, share = (1, 1, 1, 1), None
    if SCENE["fresnel"] == "exact" or reflects:
        share = nodes.add("Fresnel", (("IOR", ratio),)).outputs[0]
    if SCENE["fresnel"] == "exact":
        color = nodes.math("SUBTRACT", 1.0, share)
    shader = nodes.add("BsdfRefraction", (("Color", color), ("Roughness", 0.0), ("IOR", ratio)), distribution="SHARP").outputs[0]
    if reflects:
        mirror = nodes.add("BsdfGlossy", (("Color", (1, 1, 1, 1)), ("Roughness", 0.0)), distribution="SHARP").outputs[0]
        total = nodes.math("GREATER_THAN", share, 0.9999999)
        shader = nodes.add("MixShader", ((0, total), (1, shader), (2, mirror))).outputs[0]
    return nodes.done(shader)


def scatter(diffuser):
    """The diffuser as refraction into a medium of index n, with the normal along i - n t, by which Snell's law turns i into t."""
    nodes, index = Nodes("diffuser"), 1.5
    geometry = nodes.add("NewGeometry")
    noise = nodes.add("TexWhiteNoise", (("Vector", geometry.outputs["Position"]),), noise_dimensions="3D")
    uniform = nodes.add("SeparateXYZ", (("Vector", noise.outputs["Color"]),))
    incoming = nodes.add("VectorMath", ((0, geometry.outputs["Incoming"]), ("Scale", -1.0)), operation="SCALE").outputs[0]
    turned = incoming
    for axis, kind in enumerate(("Y_AXIS", "X_AXIS")):
        full = math.radians(diffuser["angle_deg"][axis])
        angle = nodes.math("MULTIPLY_ADD", uniform.outputs[axis], full, -full / 2)
        turned = nodes.add("VectorRotate", (("Vector", turned), ("Angle", angle)), rotation_type=kind).outputs[0]
    scaled = nodes.add("VectorMath", ((0, turned), ("Scale", -index)), operation="SCALE").outputs[0]
    across = nodes.add("VectorMath", ((0, incoming), (1, scaled)), operation="ADD").outputs[0]
    normal = nodes.add("VectorMath", ((0, across),), operation="NORMALIZE").outputs[0]
    return nodes.done(nodes.add("BsdfRefraction", (("Roughness", 0.0), ("IOR", index), ("Normal", normal)), distribution="SHARP").outputs[0])


def light(panel):
    nodes = Nodes("panel")
    picture = bpy.data.images.load(os.path.join(HERE, panel["file"]))
    picture.colorspace_settings.name = "Non-Color"
    picture.alpha_mode = "NONE"
    strength = 1.0
    if panel["emission_exponent"]:
        geometry = nodes.add("NewGeometry")
        cosine = nodes.add("VectorMath", ((0, geometry.outputs["Incoming"]), (1, geometry.outputs["Normal"])), operation="DOT_PRODUCT").outputs["Value"]
        strength = nodes.math("POWER", nodes.math("ABSOLUTE", cosine), panel["emission_exponent"])
    texture = nodes.add("TexImage", image=picture, interpolation="Closest", extension="CLIP")
    return nodes.done(nodes.add("Emission", (("Color", texture.outputs["Color"]), ("Strength", strength))).outputs[0])


def thing(name, vertices, triangles, materials, which=None, normals=None):
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", np.asarray(vertices, np.float32).ravel())
    mesh.loops.add(3 * len(triangles))
    mesh.loops.foreach_set("vertex_index", np.asarray(triangles, np.int32).ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * len(triangles), 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, np.int32))
    for material in materials:
        mesh.materials.append(material)
    if which is not None:
        mesh.polygons.foreach_set("material_index", which)
    if normals is not None:
        mesh.polygons.foreach_set("use_smooth", np.ones(len(triangles), bool))
    mesh.update(calc_edges=True)
    if normals is not None:
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(np.asarray(normals, float).tolist())
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def patches(name, parts):
    vertices, triangles, which, materials, before = [], [], [], [], 0
    for number, part in enumerate(parts):
        points, faces = read_ply(part["file"])
        vertices.append(points)
        triangles.append(faces + before)
        which.append(np.full(len(faces), number, np.int32))
        materials.append(black(part["file"]) if part["black"] else glass(part["file"], part["back"] / part["front"], part["reflects"]))
        before += len(points)
    vertices = np.concatenate(vertices)
    return thing(name, vertices[:, :3], np.concatenate(triangles), materials, np.concatenate(which), vertices[:, 3:] if SCENE["smooth"] else None)


def place_array(array):
    """Places the cells on the vertices of a parent, so that all share one mesh."""
    axes = lens_axes(array)
    lattice = thing("lattice", np.pad(axes, ((0, 0), (0, 1))), np.zeros((0, 3)), [])
    lattice.matrix_world = Matrix(array_place(array).tolist())
    lattice.instance_type = "VERTS"
    patches("cell", SCENE["cell"]).parent = lattice
    for name, leans, place in (("sheet", 1, array_place), ("layers", 0, level_place)):
        parts = [part for part in SCENE["sheet"] if part["leans"] == leans]
        if parts:
            patches(name, parts).matrix_world = Matrix(place(array).tolist())


def place_panel(panel):
    x, y = panel["width_mm"] / 2, panel["height_mm"] / 2
    made = thing("panel", [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], [(0, 1, 2), (0, 2, 3)], [light(panel)])
    made.data.uv_layers.new().data.foreach_set("uv", np.array([0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1], np.float32))


def place_diffuser(diffuser):
    h = diffuser["half_mm"]
    thing("diffuser", [(-h, -h, diffuser["z_mm"]), (4 * h, -h, diffuser["z_mm"]), (-h, 4 * h, diffuser["z_mm"])], [(0, 1, 2)], [scatter(diffuser)])


def place_camera(scene, camera):
    data = bpy.data.cameras.new("eye")
    data.sensor_fit, data.sensor_width = "HORIZONTAL", 36.0
    data.lens = 36.0 * camera["distance_mm"] / camera["frame_width_mm"]
    data.clip_start, data.clip_end = 1e-3, 1e7
    eye = bpy.data.objects.new("eye", data)
    scene.collection.objects.link(eye)
    columns = (camera["right"], camera["up"], [-f for f in camera["forward"]], camera["position_mm"])
    eye.matrix_world = Matrix([[column[row] for column in columns] for row in range(3)] + [[0, 0, 0, 1]])
    scene.camera = eye


def main():
    wanted = arguments()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    place_array(SCENE["array"])
    place_panel(SCENE["panel"])
    if SCENE["diffuser"]:
        place_diffuser(SCENE["diffuser"])
    place_camera(scene, SCENE["camera"])

    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    cycles.device = "CPU"
    cycles.samples, cycles.seed = wanted.samples, SCENE["seed"] % 2**31
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"  # the first ray goes through the pixel's centre; the others are spread over this width:
    cycles.filter_width = 1.0 if SCENE["camera"]["whole_pixels"] else 0.01
    bounces = SCENE["hits"] - 1
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, kind + "_bounces", bounces)
    cycles.min_light_bounces = cycles.min_transparent_bounces = bounces  # no roulette
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    render.resolution_x, render.resolution_y = map(int, wanted.size.split("x"))
    render.resolution_percentage = 100
    render.use_compositing = render.use_sequencer = False
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    render.filepath = os.path.abspath(wanted.output)
    bpy.ops.render.render(write_still=True)


main()
