"""The display SCENE in Mitsuba 3. Lengths are millimetres."""
import argparse
import math
import os

import drjit as dr
import mitsuba as mi
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
AT_ONCE = 1 << 21  # rays


def arguments():
    parser = argparse.ArgumentParser(prog="scene.py")
    parser.add_argument("-o", "--output", default="view.exr", help="picture to write: .exr")
    parser.add_argument("--samples", type=int, default=SCENE["samples"], help="rays per pixel")
    parser.add_argument("--size", default="x".join(map(str, SCENE["camera"]["size"])), help="pixels of the frame: WxH")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="llvm_ad_rgb (needs LLVM's library; DRJIT_LIBLLVM_PATH names it) or cuda_ad_rgb")
    return parser.parse_args()


def plugins():
    """Plugins that Mitsuba lacks: refraction without the reflected share, and a diffuser that turns a ray by two random angles."""

    class Delta(mi.BSDF):
        def __init__(self, props):
            mi.BSDF.__init__(self, props)
            flags = mi.BSDFFlags.DeltaTransmission | mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
            self.m_components, self.m_flags = [flags], flags

        def sampled(self, wo, eta, value, active):
            bs = dr.zeros(mi.BSDFSample3f, dr.width(wo))
            bs.wo, bs.eta, bs.pdf = wo, eta, mi.Float(1)
            bs.sampled_type, bs.sampled_component = mi.UInt32(+mi.BSDFFlags.DeltaTransmission), mi.UInt32(0)
            return bs, dr.select(active, mi.Color3f(value), 0)

        def eval(self, ctx, si, wo, active=True):
            return mi.Color3f(0)

        def pdf(self, ctx, si, wo, active=True):
            return mi.Float(0)

        def eval_pdf(self, ctx, si, wo, active=True):
            return mi.Color3f(0), mi.Float(0)

    class Glass(Delta):
        def __init__(self, props):
            Delta.__init__(self, props)
            self.ratio = props["ratio"]  # index behind the front side over index in front of it
            self.reflects = props["reflects"]  # whether light continues after total reflection

        def sample(self, ctx, si, sample1, sample2, active=True):
            cos_i = mi.Frame3f.cos_theta(si.wi)
            reflected, cos_t, eta_it, eta_ti = mi.fresnel(cos_i, mi.Float(self.ratio))
            total = dr.abs(cos_t) <= 0
            weight = mi.Float(1)
            if SCENE["fresnel"] == "exact":
                weight = 1 - reflected
            elif SCENE["fresnel"] == "schlick":  # the cosine is the one in the less dense medium
                less = dr.select(eta_it > 1, dr.abs(cos_i), dr.abs(cos_t))
                weight = (1 - ((self.ratio - 1) / (self.ratio + 1)) ** 2) * (1 - (1 - less) ** 5)
            value = dr.select(total, mi.Float(self.reflects), weight)
            wo = dr.select(total, mi.reflect(si.wi), mi.refract(si.wi, cos_t, eta_ti))
            return self.sampled(wo, dr.select(total, 1, eta_it), value, active)

    class Diffuser(Delta):
        def angle(self, uniform, full):
            full = math.radians(full)
            if not SCENE["diffuser"]["gaussian"]:
                return (uniform - 0.5) * full
            scale = full / (2 * math.sqrt(math.log(2)))
            return scale * dr.erfinv((2 * uniform - 1) * math.erf(math.radians(89) / scale)) if scale else mi.Float(0)

        def sample(self, ctx, si, sample1, sample2, active=True):
            i = -si.to_world(si.wi)
            a, b = (self.angle(u, full) for u, full in zip((sample2.x, sample2.y), SCENE["diffuser"]["angle_deg"]))
            (sin_a, cos_a), (sin_b, cos_b) = dr.sincos(a), dr.sincos(b)
            x, z = cos_a * i.x + sin_a * i.z, cos_a * i.z - sin_a * i.x
            t = mi.Vector3f(x, cos_b * i.y - sin_b * z, sin_b * i.y + cos_b * z)
            return self.sampled(si.to_local(t), mi.Float(1), dr.select(t.z < 0, mi.Float(1), 0), active)

    mi.register_bsdf("lfd_glass", Glass)
    mi.register_bsdf("lfd_diffuser", Diffuser)


# shared.py


def patch(part, axes):
    """The triangles of a file about each lens axis, as a single mesh: Mitsuba would compile a program for each instance."""
    array, (vertices, triangles) = SCENE["array"], read_ply(part["file"])
    place = (array_place if part["leans"] else level_place)(array)
    rotation, shift = place[:3, :3], place[:3, 3]
    places = ((vertices[None, :, :3] + np.pad(axes, ((0, 0), (0, 1)))[:, None, :]) @ rotation.T + shift).reshape(-1, 3)
    normals = np.tile(vertices[:, 3:] @ rotation.T, (len(axes), 1))
    faces = (triangles[None] + len(vertices) * np.arange(len(axes))[:, None, None]).reshape(-1, 3)
    matter = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}} if part["black"] else {"type": "lfd_glass", "ratio": part["back"] / part["front"], "reflects": part["reflects"]}
    props = mi.Properties()
    props["bsdf"] = mi.load_dict(matter)
    props["face_normals"] = not SCENE["smooth"]
    mesh = mi.Mesh(part["file"][:-4], len(places), len(faces), props=props, has_vertex_normals=bool(SCENE["smooth"]))
    values = mi.traverse(mesh)
    values["vertex_positions"] = mi.Float(places.astype(np.float32).ravel())
    values["faces"] = mi.UInt32(faces.astype(np.uint32).ravel())
    if SCENE["smooth"]:
        values["vertex_normals"] = mi.Float(normals.astype(np.float32).ravel())
    values.update()
    return mesh


def world():
    array, panel = SCENE["array"], SCENE["panel"]
    axes = lens_axes(array)
    scene = {"type": "scene"}
    for k, part in enumerate(SCENE["cell"]):
        scene[f"cell{k}"] = patch(part, axes)
    for k, part in enumerate(SCENE["sheet"]):
        scene[f"sheet{k}"] = patch(part, np.zeros((1, 2)))
    shown = np.array(mi.Bitmap(os.path.join(HERE, panel["file"])).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))
    radiance = {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(shown[::-1])), "filter_type": "nearest", "wrap_mode": "clamp", "raw": True}
    scene["panel"] = {"type": "rectangle", "to_world": mi.ScalarTransform4f(np.diag([panel["width_mm"] / 2, panel["height_mm"] / 2, 1, 1])),
                      "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}}, "emitter": {"type": "area", "radiance": radiance}}
    if SCENE["diffuser"]:
        half, z = SCENE["diffuser"]["half_mm"], SCENE["diffuser"]["z_mm"]
        scene["diffuser"] = {"type": "rectangle", "to_world": mi.ScalarTransform4f(np.array([[half, 0, 0, 0], [0, half, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]])),
                             "bsdf": {"type": "lfd_diffuser"}}
    return mi.load_dict(scene)


def follow(scene, ray, turn):
    """The light that rays collect. Each surface refracts a ray or ends it, so there is a single path; `turn`: the diffuser's random numbers."""
    context, light, weight = mi.BSDFContext(), mi.Color3f(0), mi.Color3f(1)
    active = mi.Bool(True)
    for left in range(SCENE["hits"], -1, -1):
        si = scene.ray_intersect(ray, active)
        active = active & si.is_valid()
        glow = si.emitter(scene).eval(si, active)
        if SCENE["panel"]["emission_exponent"]:
            glow = glow * dr.power(dr.abs(mi.Frame3f.cos_theta(si.wi)), SCENE["panel"]["emission_exponent"])
        light = light + dr.select(active, weight * glow, 0)
        if left:
            sample, value = si.bsdf().sample(context, si, mi.Float(0), turn, active)
            weight = weight * value
            active = active & (dr.max(value) > 0)
            # Moved along the ray, not along the normal as by spawn_ray(), which would shift oblique rays
            on = si.to_world(sample.wo)
            ray = mi.Ray3f(si.p + (1 + dr.max(dr.abs(si.p))) * 1e-5 * on, on)
            dr.eval(ray, light, weight, active)
    return np.stack([np.array(channel) for channel in (light.x, light.y, light.z)], axis=1)


def render(scene, width, height, samples):
    """Traces rays through the pixels' centres, or spread over the pixels, as many at once as memory allows."""
    camera, random = SCENE["camera"], np.random.default_rng(SCENE["seed"])
    pixel = camera["frame_width_mm"] / width
    picture = np.zeros((height, width, 3), np.float32)
    rows = max(1, min(height, AT_ONCE // width))
    for first in range(0, height, rows):
        pixels = (min(height, first + rows) - first) * width
        total = np.zeros((pixels, 3))
        for done in range(0, samples, max(1, AT_ONCE // pixels)):
            many = min(samples - done, max(1, AT_ONCE // pixels))
            index = np.repeat(np.arange(pixels), many)
            place = random.random((2, pixels * many)) if camera["whole_pixels"] else 0.5
            column, row = np.stack([index % width, index // width + first]) + place
            to = [f * camera["distance_mm"] + r * (column - 0.5 * width) * pixel + u * (0.5 * height - row) * pixel
                  for f, r, u in zip(camera["forward"], camera["right"], camera["up"])]
            ray = mi.Ray3f(mi.Point3f(*camera["position_mm"]), dr.normalize(mi.Vector3f(*(mi.Float(t.astype(np.float32)) for t in to))))
            turn = mi.Point2f(*(mi.Float(random.random(pixels * many, np.float32)) for _ in range(2))) if SCENE["diffuser"] else mi.Point2f(0)
            total += follow(scene, ray, turn).reshape(pixels, many, 3).sum(axis=1)
        picture[first:first + rows] = (total / samples).reshape(-1, width, 3)
    return picture


def main():
    wanted = arguments()
    mi.set_variant(wanted.variant)
    plugins()
    width, height = map(int, wanted.size.split("x"))
    mi.Bitmap(render(world(), width, height, wanted.samples)).write(os.path.abspath(wanted.output))


main()
