// Checks of the content: each object has one source and one size, and the inverse pick-up can use its keys.

#include "checks/findings.h"
#include "display/keys.h"
#include "geometry/vec.h"

namespace lfdsim {
namespace {

// An object is either a model or an image. `at` is the object's table with a dot at the end.
void check_source(const std::string& at, const SceneObject& o, Findings& findings) {
    const std::string model = at + "model", image = at + "image";
    if (!findings.sound(model) || !findings.sound(image)) return;
    if (!o.model.empty() && !o.image.empty())
        findings.add(image, "both {} and {} given; leave one out, or make two objects", model, image);
    if (o.model.empty() && o.image.empty()) findings.add(model, "is missing; give {}, a mesh file, or {}, a picture", model, image);
}

// An object has exactly one size: height, width, or a model's unit.
void check_size(const std::string& at, const SceneObject& o, Findings& findings) {
    for (const char* key : {"height_mm", "width_mm", "unit_mm"})
        if (!findings.sound(at + key)) return;
    const int given = int(o.height_mm.has_value()) + int(o.width_mm.has_value()) + int(o.unit_mm.has_value());
    if (given == 0) findings.add(at + "height_mm", "is missing; give {0}height_mm, {0}width_mm, or of a model {0}unit_mm", at);
    if (given > 1)
        findings.add(at + (o.unit_mm ? "unit_mm" : "width_mm"),
                     "is not the only size; leave out all but one of {0}height_mm, {0}width_mm and {0}unit_mm", at);
}

// Keys that only a model can have are refused for an image.
void check_image(const std::string& at, const SceneObject& o, Findings& findings) {
    if (o.image.empty() || !o.model.empty()) return;
    if (o.unit_mm) findings.add(at + "unit_mm", "is the unit of a model's file; give an image {0}height_mm or {0}width_mm", at);
    if (o.colour) findings.add(at + "colour", "is for models; the colours of an image are those of its file");
    if (o.shading != Shading::file) findings.add(at + "shading", "is for models; an image is not lit");
}

void check_inverse(const Content& c, Findings& findings) {
    const Inverse& inverse = c.inverse;
    const std::string at = "content.inverse.";
    if (findings.sound(at + "levels") && !(inverse.levels[0] < inverse.levels[1]))
        findings.add(at + "levels", "are {} and {}; the content's black must be darker than its white", inverse.levels[0],
                     inverse.levels[1]);
    const std::size_t corners = inverse.eyes_mm.size();
    if (findings.sound(at + "eyes_mm") && corners != 0 && corners != 2 && corners != 4)
        findings.add(at + "eyes_mm", "has {} points; give two opposite corners of a box, or four of two boxes", corners);
    if (c.pickup == PickupKind::inverse && c.sampling == ContentSampling::pixel && findings.sound("content.sampling"))
        findings.add("content.sampling",
                     "is \"pixel\", which the inverse pick-up does not support: it solves for the light of each subpixel");
}

}  // namespace

void validate_content(const Display& d, Findings& findings) {
    const Content& c = d.content;
    if (findings.sound("content.light.direction") && length(c.light.direction) < shortest_mm)
        findings.add("content.light.direction", "has the length {} and so no direction; leave it out, or take [0, 0, 1]",
                     length(c.light.direction));
    if (c.objects.size() > max_objects)
        findings.add("content.object", "has more than the {} objects allowed; join some in one model file", max_objects);
    if (!c.objects.empty() && !c.model.empty() && findings.sound("content.model"))
        findings.add(
            "content.model",
            "both content.model and [[content.object]] given; make the model an object, too, or leave one out (--model FILE "
            "shows a file in place of the objects)");
    check_inverse(c, findings);
    for (std::size_t i = 0; i < c.objects.size(); ++i) {
        const std::string at = fmt::format("content.object.{}.", i);
        check_source(at, c.objects[i], findings);
        check_size(at, c.objects[i], findings);
        check_image(at, c.objects[i], findings);
    }
}

}  // namespace lfdsim
