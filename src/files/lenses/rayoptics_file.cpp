#include "base/text.h"
#include "files/lenses/lens_json.h"

#include <algorithm>

// The .roa of ray-optics: objects are {"__instance_type__": [module, class], "attributes": {...}}. Interfaces and the gaps between
// them are lists; the shape of an interface is the profile that its profile_id names in a dictionary. Lengths are in a unit that
// the file names last, so the lens is scaled at the end.
namespace lfdsim {
namespace {

const LensJson& attributes(const LensJson& object) { return member(object, "attributes"); }

// Returns the class of an object; of anything else its text.
std::string class_of(const LensJson& object) {
    const LensJson& names = member(object, "__instance_type__");
    return names.is_array() && names.size() == 2 ? word_of(names[1]) : word_of(object);
}

class RayOpticsReader : LensJsonReader {
  public:
    explicit RayOpticsReader(std::string_view file) : LensJsonReader(file) {}

    DrawnLens read(const LensJson& json) {
        const LensJson& model = attributes(member(json, "optical_model"));
        const LensJson& sequence = attributes(member(model, "seq_model"));
        const LensJson& interfaces = list(member(sequence, "ifcs"), "seq_model.ifcs", 3);
        const LensJson& gaps = list(member(sequence, "gaps"), "seq_model.gaps", interfaces.size() - 1);
        for (std::size_t i = 0; i < interfaces.size(); ++i) {
            read_interface(interfaces[i], fmt::format("ifcs[{}]", i), member(model, "profile_dict"));
            if (i + 1 < interfaces.size()) read_gap(attributes(gaps[i]), fmt::format("gaps[{}]", i));
        }
        if (const LensJson& stop = member(sequence, "stop_surface"); !stop.is_null()) {
            const double i = number(stop, "seq_model.stop_surface");
            if (i > 0 && i < double(interfaces.size() - 1)) lens.surfaces[std::size_t(i)].is_stop = true;
        }
        const LensJson& system = attributes(member(model, "system_spec"));
        if (member(system, "title").is_string()) lens.title = member(system, "title").get<std::string>();
        read_wavelength(attributes(member(attributes(member(model, "optical_spec")), "spectral_region")));
        read_unit(lower_case(word_of(member(system, "_dimensions"))));
        return done();
    }

  private:
    void read_interface(const LensJson& json, const std::string& place, const LensJson& profiles) {
        DrawnSurface& s = lens.surfaces.emplace_back();
        s.place = fmt::format("{}: {}", name, place);
        const LensJson& its = attributes(json);
        if (class_of(json) != "Surface") refuse(place, "is of type {}, which cannot be imported; Surface can", class_of(json));
        if (const LensJson& mode = member(its, "interact_mode"); mode != "transmit" && mode != "dummy")
            refuse(place, "is to {} light; only lenses can be imported", word_of(mode));
        if (!member(its, "decenter").is_null()) refuse(place, "is shifted or tilted; only lenses about one axis can be imported");
        if (!member(its, "phase_element").is_null()) refuse(place, "has a phase element; only refraction can be imported");
        const LensJson& id = member(its, "profile_id");
        read_profile(id.is_string() ? member(profiles, id.get<std::string>()) : member(its, "profile"), place, s);
        if (lens.surfaces.size() == 1) return;  // the object's width is not the lens's
        if (const LensJson& width = member(its, "max_aperture"); width.is_number() && width.get<double>() > 0)
            s.semi_aperture_mm = width.get<double>();
        for (const LensJson& aperture : member(its, "clear_apertures")) read_aperture(aperture, place, s);
    }

    static constexpr std::size_t most_terms = 100;  // of a profile

    // Reads curvature cv, conic constant (cc, or ec = k + 1) and polynomial coefficients of a profile.
    void read_profile(const LensJson& json, const std::string& place, DrawnSurface& s) {
        const std::string type = class_of(json);
        const LensJson& its = attributes(json);
        const bool all_powers = type == "RadialPolynomial";  // coefficients of r, r^2, r^3, ...; else of r^2, r^4, ...
        if (type != "Spherical" && type != "Conic" && type != "EvenPolynomial" && !all_powers)
            return refuse(place, "has a profile of type {}, which cannot be imported; Spherical, Conic and EvenPolynomial can",
                          type);
        s.curvature_per_mm = number(member(its, "cv"), place + ".cv");
        if (const LensJson& ec = member(its, "ec"); !ec.is_null()) s.conic = number(ec, place + ".ec") - 1;
        if (const LensJson& cc = member(its, "cc"); !cc.is_null()) s.conic = number(cc, place + ".cc");
        const LensJson& terms = member(its, "coefs");
        if (type == "Spherical" || type == "Conic") return;
        if (!terms.is_array() || terms.size() > most_terms)
            return refuse(place + ".coefs", "are no list of up to {} coefficients", most_terms);
        double a2 = 0;
        for (std::size_t k = 0; k < terms.size(); ++k) {
            const double a = number(terms[k], fmt::format("{}.coefs[{}]", place, k));
            const std::size_t power = all_powers ? k + 1 : 2 * k + 2;
            if (power % 2 == 1 && a != 0)
                return refuse(place, "has a term in r^{}, which cannot be imported; even powers can", power);
            if (power == 2) a2 = a;
            if (power > 2 && power % 2 == 0) s.even_asphere.push_back(a);
        }
        while (!s.even_asphere.empty() && s.even_asphere.back() == 0) s.even_asphere.pop_back();
        if (!fold_r2(s, a2))
            refuse(place, "has the term {} r^2 beside the conic constant {}, which surfaces here do not have", a2, s.conic);
    }

    void read_aperture(const LensJson& json, const std::string& place, DrawnSurface& s) {
        const LensJson& its = attributes(json);
        if (class_of(json) != "Circular" || is_true(member(its, "is_obscuration")))
            return refuse(place, "has an aperture of type {}, which cannot be imported; Circular can", class_of(json));
        for (const char* key : {"x_offset", "y_offset"})
            if (const LensJson& offset = member(its, key); !offset.is_null() && number(offset, place) != 0)
                refuse(place, "has a decentred aperture; only circles about the axis can be imported");
        const double radius = number(member(its, "radius"), place + ".radius");
        s.semi_aperture_mm = s.is_hole ? std::min(*s.semi_aperture_mm, radius) : radius;  // the smallest one counts
        s.is_hole = true;
    }

    // Reads thickness and medium of the space after the last interface that was read.
    void read_gap(const LensJson& gap, const std::string& place) {
        DrawnSurface& s = lens.surfaces.back();
        s.distance_mm = number(member(gap, "thi"), place + ".thi");
        const LensJson &medium = member(gap, "medium"), &its = attributes(medium);
        const std::string type = class_of(medium);
        if (type == "Air") return;
        if (const LensJson& glass = member(its, "gname"); glass.is_string() && glass != "") {
            s.medium.glass = glass.get<std::string>();
        } else if (const LensJson& n = member(its, "n"); n.is_number()) {
            s.medium.nd = n.get<double>();
            if (const LensJson& v = member(its, "v"); v.is_number() && v != 0) s.medium.vd = v.get<double>();
        } else {
            refuse(place, "has a medium of type {}, which cannot be imported; glasses by name, or by n and v, can", type);
        }
    }

    void read_wavelength(const LensJson& spectrum) {
        const LensJson &waves = member(spectrum, "wavelengths"), &reference = member(spectrum, "reference_wvl");
        if (waves.is_array() && reference.is_number_unsigned() && reference.get<std::size_t>() < waves.size())
            lens.beam.wavelength_nm = number(waves[reference.get<std::size_t>()], "spectral_region.wavelengths");
    }

    void read_unit(const std::string& unit) {
        constexpr std::pair<std::string_view, double> units[] = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}};
        const auto known = std::find_if(std::begin(units), std::end(units), [&](const auto& u) { return u.first == unit; });
        if (known == std::end(units))
            refuse("system_spec._dimensions", "{} is unknown; known are mm, cm, m, in and ft", unit);
        else
            scale(lens, known->second);
    }
};

}  // namespace

DrawnLens parse_rayoptics(std::string_view text, std::string_view name) {
    return RayOpticsReader(name).read(parse_lens_json(text, name));
}

}  // namespace lfdsim
