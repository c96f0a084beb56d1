// Facts about a display that are constants where the tracer is compiled. Floor 1.
//
// The tracer is written once, for any display. A copy of it for displays of which something is known tests less: the one for the
// 2019 paper's lens has no Newton iteration, no stop and no layers. `Specialisations` lists the copies, and a display takes the
// first whose facts hold. All copies compute the same bits, so a row more or less changes speed and size alone.
#pragma once
#include "optics/traced_display.h"
#include "simd/config.h"

namespace lfdsim::optics {

/// Knowledge of a fact at compile time: it does not hold, it holds, or it is tested on the display at run time.
enum class Known : std::int8_t { no, yes, ask };

/// What is known of a display at compile time. A default value knows nothing but that surfaces are not meshes.
struct Facts {
    Known ideal = Known::ask;         // thin lenses, or pinholes
    Known lit_between = Known::ask;   // light passes the array between its lenses, through glass
    Known misaligned = Known::ask;    // the array has assembly errors
    Known plano_convex = Known::ask;  // a spherical cap over a plane, without a stop: the 2019 paper's lens
    Known strips = Known::ask;        // lenses as strips
    Known staggered = Known::ask;     // every other row is shifted: hexagons and bricks
    Known on_air = Known::ask;        // air is between the lenses and a bare panel
    Known plain_light = Known::ask;   // has_plain_light()
    Known schlick = Known::ask;       // Fresnel's equations by Schlick's approximation
    Known meshed = Known::no;         // triangles represent the surfaces (src/interchange/meshed); no display has this by itself

    bool operator==(const Facts&) const = default;
    /// Returns these facts and one more, which holds.
    consteval Facts with(Known Facts::*fact) const {
        Facts facts = *this;
        facts.*fact = Known::yes;
        return facts;
    }
};

inline namespace LFDSIM_ISA {

/// Returns whether a fact holds: as it is known, or else `asked`, the display's answer, which the compiler drops where it is known.
template <Known known>
LFDSIM_FN constexpr bool holds(bool asked) {
    return known == Known::ask ? asked : known == Known::yes;
}

/// Returns whether light is what it is on most displays and cameras: a pinhole camera through pixels' centres, a box diffuser above
/// the lenses, pixels that emit over their whole area and in all directions alike, round lenses along the panel's axes.
template <class S>
LFDSIM_FN bool has_plain_light(const TracedDisplay<S>& display) {
    return !display.box_filter && !display.thin_lens && display.has_diffuser && display.start_above != S(0) && !display.rotated &&
           display.diffuser_profile == Profile::box && display.emission_exponent == S(0) && display.emission.whole &&
           display.aperture == Aperture::circle;
}

/// Returns whether the lens is a spherical cap over a plane face, convex to the viewer and without a stop.
template <class S>
LFDSIM_FN bool is_plano_convex(const TracedDisplay<S>& display) {
    return !display.ideal && display.surface_count == 2 && display.surface[0].shape == Shape::sphere &&
           display.surface[1].shape == Shape::plane && !display.has_stop && !display.concave_front;
}

/// Returns whether light reaches the panel between lenses, too: the surround is `clear` or `plate`, which ideal lenses do not have.
template <class S>
LFDSIM_FN bool is_lit_between(const TracedDisplay<S>& display) {
    return !display.ideal && display.surround != Surround::opaque;
}

/// Returns whether all that is known holds for a display: whether a copy of the tracer compiled with these facts may trace it.
/// `meshed` is not tested, as no TracedDisplay contains it.
template <Facts facts, class S>
LFDSIM_FN bool hold(const TracedDisplay<S>& display) {
    const auto agrees = [](Known known, bool answer) { return known == Known::ask || answer == (known == Known::yes); };
    return agrees(facts.ideal, display.ideal) && agrees(facts.lit_between, is_lit_between(display)) &&
           agrees(facts.misaligned, display.misaligned.given) && agrees(facts.plano_convex, is_plano_convex(display)) &&
           agrees(facts.strips, display.lattice.strips) && agrees(facts.staggered, display.lattice.staggered) &&
           agrees(facts.on_air, !display.glued && display.layer_count == 0) &&
           agrees(facts.plain_light, has_plain_light(display)) && agrees(facts.schlick, display.fresnel == Fresnel::schlick);
}

/// The copies of the tracer, best first. LFDSIM_FEW_SPECIALISATIONS leaves the general ones, and a CPU gains nothing from plain
/// light (LFDSIM_PLAIN_LIGHT): on a GPU code that is left out makes room in the cache of instructions.
/// The last row serves for all displays for which neither of the two before it holds, so every display has a row.
struct Specialisations {
    using enum Known;
    static constexpr Facts paper{
        .ideal = no, .lit_between = no, .misaligned = no, .plano_convex = yes, .strips = no, .staggered = no, .on_air = yes};
    static constexpr Facts opaque{.ideal = no, .lit_between = no, .misaligned = no, .strips = no, .staggered = no, .on_air = yes};
    static constexpr Facts ideal{.ideal = yes, .lit_between = no, .misaligned = no, .strips = no, .staggered = no, .on_air = yes};
    static constexpr Facts lit_between{.ideal = no, .lit_between = yes, .misaligned = no};
    static constexpr Facts misaligned{.misaligned = yes};
    static constexpr Facts meshed{
        .ideal = no, .lit_between = no, .misaligned = no, .strips = no, .staggered = no, .on_air = yes, .meshed = yes};
    static constexpr Facts others{.lit_between = no, .misaligned = no};

    static constexpr Facts paper_plain = paper.with(&Facts::plain_light), paper_plain_schlick = paper_plain.with(&Facts::schlick);
    static constexpr Facts paper_strips = paper.with(&Facts::strips), paper_staggered = paper.with(&Facts::staggered);
    static constexpr Facts misaligned_paper = paper.with(&Facts::misaligned), misaligned_opaque = opaque.with(&Facts::misaligned);

    // clang-format off
    static constexpr Facts row[] = {
#ifdef LFDSIM_PLAIN_LIGHT
        paper_plain_schlick, paper_plain,
#endif
#ifndef LFDSIM_FEW_SPECIALISATIONS
        paper, paper_strips, paper_staggered, opaque, ideal, misaligned_paper, misaligned_opaque,
#endif
        lit_between, misaligned, others};
    // clang-format on
    static constexpr int count = sizeof row / sizeof row[0];

    /// Returns the number of a row, counted from 0, for CUDA, whose kernels take no template arguments of class type.
    template <Facts facts>
    static constexpr int number_of() {
        int number = 0;
        while (!(row[number] == facts)) ++number;
        return number;
    }
};

/// Calls do_it.operator()<facts>() with the first row of facts, from number `row` on, that holds for a display, and returns its
/// result. The last row is taken untested.
template <int row = 0, class S, class Do>
inline auto with_facts(const TracedDisplay<S>& display, const Do& do_it)
    -> decltype(do_it.template operator()<Specialisations::row[row]>()) {
    constexpr Facts facts = Specialisations::row[row];
    if constexpr (row + 1 == Specialisations::count) {
        return do_it.template operator()<facts>();
    } else {
        if (hold<facts>(display)) return do_it.template operator()<facts>();
        return with_facts<row + 1>(display, do_it);
    }
}

/// Calls do_it.operator()<facts>() for all rows from number `row` on, one after the other.
template <int row = 0, class Do>
inline void for_all_specialisations(const Do& do_it) {
    do_it.template operator()<Specialisations::row[row]>();
    if constexpr (row + 1 < Specialisations::count) for_all_specialisations<row + 1>(do_it);
}

}  // namespace LFDSIM_ISA
}  // namespace lfdsim::optics
