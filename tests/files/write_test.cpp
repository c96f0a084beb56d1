// What write_display() writes reads back the same, to the last bit.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "display/keys.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

// Any value that a key allows, far beyond what displays are made of.
double any_number(const Range& range) {
    const double high = std::min(range.high, 1e9);
    double x = range.low + (high - range.low) * (*rc::gen::inRange(0, 1 << 30) / double(1 << 30));
    if (*rc::gen::arbitrary<bool>()) x = range.low + (x - range.low) * 1e-12;
    return range.contains(x) ? x : (range.low + high) / 2;
}
void fill(double& x, const Range& range) { x = any_number(range); }
void fill(std::optional<double>& x, const Range& range) {
    if (*rc::gen::arbitrary<bool>())
        x = any_number(range);
    else
        x.reset();
}
void fill(std::int64_t& x, const Range& range) {
    x = *rc::gen::arbitrary<bool>() ? std::int64_t(any_number(range)) + 1 : INT64_MAX;
}
void fill(std::string& x, const Range&) {
    x = *rc::gen::container<std::string>(
        rc::gen::element('a', ' ', '"', '\'', '\\', '\n', '\t', '\x01', '\x7f', '#', '=', '[', '.'));
    if (*rc::gen::arbitrary<bool>()) x += "\xc3\xa9\xf0\x9f\x94\xad";  // UTF-8
}
void fill(std::vector<double>& x, const Range& range) {
    x.resize(*rc::gen::inRange<std::size_t>(0, max_asphere_terms + 1));
    for (double& a : x) a = any_number(range);
}
void fill(std::optional<std::int64_t>& x, const Range& range) {
    x.reset();
    if (*rc::gen::arbitrary<bool>()) fill(x.emplace(), range);
}
template <class T, std::size_t n>
void fill(std::array<T, n>& x, const Range& range) {
    for (T& a : x) fill(a, range);
}
void fill(std::vector<Vec3d>& x, const Range& range) {
    x.resize(2 * *rc::gen::inRange<std::size_t>(0, 3));
    for (Vec3d& point : x) fill(point, range);
}
void fill(Pitch& x, const Range& range) { x = any_number(range); }
void fill(LensKind&, const Range&) {}  // each kind has a start of its own
template <class E>
requires std::is_enum_v<E>
void fill(E& x, const Range&) { x = E(*rc::gen::inRange<std::size_t>(0, words<E>().size())); }

template <class T, std::size_t n>
void fill(std::optional<std::array<T, n>>& x, const Range& range) {
    if (*rc::gen::arbitrary<bool>()) return x.reset();
    for (T& one : x.emplace()) fill(one, range);
}

void fill(std::vector<std::string>&, const Range&) {}  // files, which would be read
void fill(std::optional<Glass>& x, const Range&) {
    const auto near = [](double size) { return size * (1 + *rc::gen::inRange(0, 1 << 30) / double(1 << 30)); };
    const auto& all = shipped_glasses();
    const std::vector<Glass> forms{{"", Formula::nd_vd, {near(1.2), near(30)}},
                                   {"", Formula::cauchy, {near(1.2), near(0.004), near(1e-5)}},
                                   {"", Formula::sellmeier, {near(0.7), near(0.005), near(0.1), near(0.02), near(0.5), near(60)}},
                                   all[*rc::gen::inRange<std::size_t>(0, all.size())].glass};
    x = *rc::gen::elementOf(forms);
}

constexpr const char* start_texts[] = {
    R"(lens = {type = "ideal", focal_length_mm = 2, aperture_radius_mm = 1}
array = {count = [1, 1], pitch_mm = 2, gap_mm = 3})",
    R"(lens = {type = "plano_convex", sphere_radius_mm = 9, aperture_radius_mm = 3, index = 1.5}
array = {count = [1, 1], pitch_mm = 6, gap_mm = 3})",
    R"(lens = {type = "surfaces", surface = [{semi_aperture_mm = 1, index = 2, distance_mm = 1}, {semi_aperture_mm = 1}]}
array = {count = [1, 1], pitch_mm = 2, base_z_mm = 3})",
    R"(lens = {type = "plano_convex", sphere_radius_mm = 9, aperture_radius_mm = 3, glass = "PC"}
array = {count = [1, 1], pitch_mm = 6, gap_mm = 3})",
    R"(lens = {type = "surfaces", surface = [{semi_aperture_mm = 1, glass = "F2", distance_mm = 1}, {semi_aperture_mm = 1}]}
array = {count = [1, 1], pitch_mm = 2, base_z_mm = 3})",
    R"(lens = {type = "ideal", focal_length_mm = 2, aperture_radius_mm = 1}
array = {count = [1, 1], pitch_mm = 2, gap_mm = 3}
content = {light = {ambient = 0}, object = [{image = "a.png", width_mm = 2}, {model = "b", unit_mm = 3, colour = [0, 1, 0.5]}]})"};

// Starts from a small display of each lens type and changes it at random; changes that leave it valid stay.
TEST(WriteDisplay, ReadsBackTheSame) {
    EXPECT_TRUE(rc::check([] {
        const std::string start = *rc::gen::elementOf(std::vector<std::string>(std::begin(start_texts), std::end(start_texts)));
        Display d = parse_display("schema = 1\npanel = {pixels = [1, 1], pixel_pitch_mm = 1}\n" + start, "start");
        const auto fill_value = [](const KeyInfo& key, ValueRef value) {
            std::visit([&](auto* v) { fill(*v, key.range); }, value);
        };
        const auto change = [&](auto&& act) {
            Display changed = d;
            act(changed);
            if (validate(changed).empty()) d = std::move(changed);
        };
        d.diffuser = Diffuser{1, {1, 1}};
        if (!validate(d).empty()) d.diffuser.reset();
        // All values of these tables at once; each of the others by itself.
        for (const std::string_view table : {"diffuser.", "content.", "render."})
            change([&](Display& c) {
                visit_all(c, [&](const std::string& path, const KeyInfo& key, ValueRef value) {
                    if (path.starts_with(table)) fill_value(key, value);
                });
            });
        std::vector<std::string> paths;
        visit_all(d, [&](const std::string& path, const KeyInfo&, ValueRef) { paths.push_back(path); });
        for (const std::string& one : paths)
            change([&](Display& c) {
                visit_all(c, [&](const std::string& path, const KeyInfo& key, ValueRef value) {
                    if (path == one && path != "errors.table") fill_value(key, value);  // of a file that is there
                });
            });
        const std::string text = write_display(d);
        RC_ASSERT(parse_display(text, "written") == d);
    }));
}

}  // namespace
}  // namespace lfdsim
