#include "files/lenses/lens_json.h"

#include <algorithm>
#include <cmath>

// Optiland's .json, which the `to_dict()` of its Optic returns. Lengths are in mm, wavelengths in micrometres; each surface has a
// position in a frame whose z is the axis.
namespace lfdsim {
namespace {

class OptilandReader : LensJsonReader {
  public:
    explicit OptilandReader(std::string_view file) : LensJsonReader(file) {}

    DrawnLens read(const LensJson& json) {
        const LensJson& surfaces = list(member(member(json, "surface_group"), "surfaces"), "surface_group.surfaces", 3);
        for (std::size_t i = 0; i < surfaces.size(); ++i) read_surface(surfaces[i], i);
        for (std::size_t i = 0; i + 1 < surfaces.size(); ++i) lens.surfaces[i].distance_mm = z_mm[i + 1] - z_mm[i];
        if (member(json, "name").is_string()) lens.title = member(json, "name").get<std::string>();
        read_beam(json);
        if (!coated.empty())
            lens.notes.push_back(fmt::format("The coatings of surfaces {} are not read: all glass is bare.", coated));
        return done();
    }

  private:
    void read_surface(const LensJson& json, std::size_t i) {
        const std::string place = fmt::format("surface_group.surfaces[{}]", i);
        DrawnSurface& s = lens.surfaces.emplace_back();
        s.place = fmt::format("{}: {}", name, place);
        const std::string type = word_of(member(json, "type"));
        if (type != "Surface" && type != "ObjectSurface" && type != "ImageSurface")
            refuse(place, "is of type {}, which cannot be imported; Surface can", type);
        read_place(member(member(json, "geometry"), "cs"), place + ".geometry.cs", i == 0);
        read_shape(member(json, "geometry"), place + ".geometry", s);
        read_medium(member(json, "material_post"), place + ".material_post", s.medium);
        read_aperture(member(json, "aperture"), place + ".aperture", s);
        s.is_stop = is_true(member(json, "is_stop"));
        const LensJson& acts = member(json, "interaction_model");
        if (is_true(member(json, "is_reflective")) || is_true(member(acts, "is_reflective")))
            refuse(place, "is a mirror; only lenses can be imported");
        if (!acts.is_null() && member(acts, "type") != "RefractiveReflectiveModel" &&
            member(acts, "type") != "refractive_reflective")
            refuse(place, "acts as a {}; only refraction can be imported", word_of(member(acts, "type")));
        if (!member(acts, "bsdf").is_null() || !member(json, "bsdf").is_null())
            refuse(place, "scatters light; only refraction can be imported");
        if (!member(acts, "coating").is_null() || !member(json, "coating").is_null())
            coated += fmt::format("{}{}", coated.empty() ? "" : ", ", i);
    }

    // Reads the position of a surface, which must be on the axis and upright; the object may be at infinity.
    void read_place(const LensJson& frame, const std::string& place, bool is_object) {
        for (const char* key : {"x", "y", "rx", "ry"})
            if (const double shift = number(member(frame, key), place + "." + key); shift != 0)
                refuse(place, "{} = {}: is shifted or tilted; only lenses about one axis can be imported", key, shift);
        if (!member(frame, "reference_cs").is_null())
            refuse(place, "has a reference_cs; only lenses about one axis can be imported");
        z_mm.push_back(number(member(frame, "z"), place + ".z", is_object));
    }

    // Reads curvature, conic constant and the coefficients of r^2, r^4, ...
    void read_shape(const LensJson& shape, const std::string& place, DrawnSurface& s) {
        const std::string type = word_of(member(shape, "type"));
        if (type == "Plane") return;
        if (type != "StandardGeometry" && type != "EvenAsphere")
            return refuse(place, "is of type {}, which cannot be imported; Plane, StandardGeometry and EvenAsphere can", type);
        const double radius = number(member(shape, "radius"), place + ".radius", true);
        if (member(shape, "radius") == 0) refuse(place + ".radius", "is 0");
        s.curvature_per_mm = radius == 0 ? 0 : 1 / radius;
        if (!member(shape, "conic").is_null()) s.conic = number(member(shape, "conic"), place + ".conic");
        if (type == "StandardGeometry") return;
        const LensJson& terms = member(shape, "coefficients");
        if (!terms.is_array() || terms.size() > 100) return refuse(place + ".coefficients", "is not a list of numbers");
        for (std::size_t k = 1; k < terms.size(); ++k)
            s.even_asphere.push_back(number(terms[k], fmt::format("{}.coefficients[{}]", place, k)));
        while (!s.even_asphere.empty() && s.even_asphere.back() == 0) s.even_asphere.pop_back();
        if (const double a2 = terms.empty() ? 0 : number(terms[0], place + ".coefficients[0]"); !fold_r2(s, a2))
            refuse(place + ".coefficients[0]", "is {}, a term in r^2 beside the conic constant {}, which surfaces here do not have",
                   a2, s.conic);
    }

    void read_medium(const LensJson& material, const std::string& place, DrawnMedium& medium) {
        const std::string type = word_of(member(material, "type"));
        if (type == "Material") {
            medium.glass = member(material, "name").is_string() ? member(material, "name").get<std::string>() : "";
            if (medium.glass.empty()) refuse(place, "has no name");
        } else if (type == "IdealMaterial" || type == "AbbeMaterial") {
            medium.nd = number(member(material, "index"), place + ".index");
            if (type == "AbbeMaterial") medium.vd = number(member(material, "abbe"), place + ".abbe");
        } else {
            refuse(place, "is of type {}, which cannot be imported; Material, IdealMaterial and AbbeMaterial can", type);
        }
    }

    void read_aperture(const LensJson& aperture, const std::string& place, DrawnSurface& s) {
        if (aperture.is_null()) return;
        if (member(aperture, "type") != "RadialAperture")
            return refuse(place, "is of type {}, which cannot be imported; RadialAperture can", word_of(member(aperture, "type")));
        if (number(member(aperture, "r_min"), place + ".r_min") != 0)
            refuse(place, "has a central obscuration; only full circles can be imported");
        if (const double radius = number(member(aperture, "r_max"), place + ".r_max", true); std::isfinite(radius))
            s.semi_aperture_mm = radius, s.is_hole = true;
    }

    // Reads pupil or f-number, field and main wavelength, as far as they are of a kind that fill_apertures() can use.
    void read_beam(const LensJson& json) {
        const LensJson& aperture = member(json, "aperture");
        const std::string type = word_of(member(aperture, "type"));
        if (type == "EPD") lens.beam.entrance_pupil_mm = number(member(aperture, "value"), "aperture.value");
        if (type == "imageFNO") lens.beam.f_number = number(member(aperture, "value"), "aperture.value");
        if (type == "float_by_stop_size")
            for (DrawnSurface& s : lens.surfaces)
                if (s.is_stop && !s.semi_aperture_mm) s.semi_aperture_mm = number(member(aperture, "value"), "aperture.value") / 2;
        const LensJson& fields = member(json, "fields");
        const LensJson &kind = member(member(fields, "field_definition"), "field_type"), &old_kind = member(fields, "field_type");
        const bool is_angle = kind == "AngleField" || old_kind == "angle";
        // A chief ray that is telecentric before the lens crosses no pupil there.
        const bool is_height =
            (kind == "ObjectHeightField" || old_kind == "object_height") && !is_true(member(fields, "telecentric"));
        if (is_angle || is_height)
            for (const LensJson& field : member(fields, "fields")) {
                const double x = number(member(field, "x"), "fields"), y = number(member(field, "y"), "fields");
                std::optional<double>& most = is_angle ? lens.beam.field_slope : lens.beam.object_height_mm;
                most = std::max(most.value_or(0), is_angle ? slope_of_field(x, y) : std::hypot(x, y));
            }
        for (const LensJson& wave : member(member(json, "wavelengths"), "wavelengths"))
            if (is_true(member(wave, "is_primary")) && member(wave, "unit") == "um")
                lens.beam.wavelength_nm = number(member(wave, "value"), "wavelengths") * 1000;
    }

    std::vector<double> z_mm;  // of each surface's vertex
    std::string coated;        // numbers of surfaces with coatings, for a note
};

}  // namespace

DrawnLens parse_optiland(std::string_view text, std::string_view name) {
    return OptilandReader(name).read(parse_lens_json(text, name));
}

}  // namespace lfdsim
