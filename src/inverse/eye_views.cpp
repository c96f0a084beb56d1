#include "inverse/eye_views.h"

#include "base/input_error.h"
#include "engine/render.h"
#include "geometry/camera.h"
#include "geometry/vec.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lfdsim {
namespace {

constexpr double least_light = 0.6;  // of the gain: where all elements nearby see less of a white panel none of them counts
constexpr double least_share = 0.6;  // of the most light nearby: one with less lies mostly between lenses or beside the array
constexpr double whole_share = 0.9;  // an element with more lies in front of lenses all over
constexpr float unknown_light = std::numeric_limits<float>::quiet_NaN();  // of content: an element with it does not count
constexpr double dim_share = 0.3;  // of the brightest: an element that sees less does not count for the gain

float mean_of(const Image& image, std::size_t p) { return (image.rgb[3 * p] + image.rgb[3 * p + 1] + image.rgb[3 * p + 2]) / 3; }

/// Replaces each of `count` numbers, `step` apart, by the largest of those within `within` places of it.
void take_largest(std::vector<float>& of, std::size_t first, std::size_t step, int count, int within) {
    std::vector<float> line(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) line[std::size_t(k)] = of[first + std::size_t(k) * step];
    for (int k = 0; k < count; ++k)
        of[first + std::size_t(k) * step] =
            *std::max_element(line.begin() + std::max(k - within, 0), line.begin() + std::min(k + within + 1, count));
}

/// The light of a white panel in each element of a view, and the greatest light of the elements within a lens pitch of it.
struct WhiteLight {
    std::vector<float> here, nearby;
    explicit WhiteLight(const View& view) : here(view.white.rgb.size() / 3) {
        const int width = view.white.width, height = view.white.height, within = view.elements_per_lens;
        for (std::size_t p = 0; p < here.size(); ++p) here[p] = mean_of(view.white, p);
        nearby = here;
        for (int y = 0; y < height; ++y) take_largest(nearby, std::size_t(y) * std::size_t(width), 1, width, within);
        for (int x = 0; x < width; ++x) take_largest(nearby, std::size_t(x), std::size_t(width), height, within);
    }
};

/// Returns how many elements of a view lie across a lens pitch, rounded up.
int elements_across_lens(const Display& seen, const Geometry& geometry) {
    const double pitch = is_strips(seen.array) ? seen.array.pitch_mm[0] : std::max(seen.array.pitch_mm[0], seen.array.pitch_mm[1]);
    return int(std::ceil(std::min(pitch / geometry.frame_width_mm, 1.) * double(seen.camera.resolution[0])));
}

}  // namespace

ContentOf photographs_of(const ContentScene& scene, int threads) {
    return [&scene, threads](const Display& seen, const Geometry& geometry, std::int64_t samples, Job& job) {
        Display camera = seen;
        camera.render.samples = samples;
        return reference_photograph(camera, geometry, scene, threads, {}, job).image;
    };
}

ContentOf pictures_of(const LightField& field, double focus_z_mm, std::span<const EyeBox> boxes, FieldRays& rays) {
    return [&field, focus_z_mm, boxes, &rays](const Display& seen, const Geometry& geometry, std::int64_t samples, Job&) {
        const Camera& camera = seen.camera;
        const CameraAxes axes = camera_axes(camera);
        const Vec3d& eye = camera.position_mm;
        Image image(int(camera.resolution[0]), int(camera.resolution[1]));
        // The mean over a grid of lines in each pixel
        const int each = int(std::lround(std::sqrt(double(samples))));
        const double slope = geometry.frame_width_mm / axes.distance_mm / (double(image.width) * each);  // from line to line
        std::int64_t unseen = 0;
        for (int row = 0; row < image.height * each; ++row)
            for (int column = 0; column < image.width * each; ++column) {
                const double right = (column + 0.5 - 0.5 * image.width * each) * slope,
                             up = (0.5 * image.height * each - row - 0.5) * slope;
                Vec3d to = axes.forward;
                for (std::size_t c = 0; c < 3; ++c) to[c] += right * axes.right[c] + up * axes.up[c];
                const double down = (eye[2] - focus_z_mm) / -to[2], back = field.grid().distance_mm / to[2];
                const double x = eye[0] + to[0] * down, y = eye[1] + to[1] * down;
                const LightField::FieldLine line{float(x), float(y), float(x + to[0] * back), float(y + to[1] * back)};
                float light[3];
                const auto answer = field.light(line, {float(slope), float(eye[2] - focus_z_mm)}, light);
                float* const pixel = image.at(column / each, row / each);
                for (int c = 0; c < 3; ++c)
                    pixel[c] += answer == LightField::Answer::seen ? light[c] / float(each * each) : unknown_light;
                unseen += answer == LightField::Answer::beside_cameras;
            }
        if (std::ranges::any_of(boxes, [&](const EyeBox& box) { return is_inside(box, eye); })) {
            rays.all += std::int64_t(image.rgb.size() / 3) * each * each;
            rays.unseen += unseen;
        }
        return image;
    };
}

std::optional<std::vector<View>> views_of(const Request& request, const Display& display, std::span<const Eye> eyes,
                                          std::int64_t rays, std::int64_t white_points, std::int64_t samples,
                                          const SummedPanel& white, const char* stage) {
    const Geometry geometry = resolve(display);
    request.job.stage(stage, std::int64_t(eyes.size()));
    std::vector<std::optional<View>> made(eyes.size());
    Quiet quiet(request.job);
    tbb::parallel_for(std::size_t(0), eyes.size(), [&](std::size_t k) {
        if (request.job.cancelled()) return;
        const Eye& eye = eyes[k];
        const Display seen = display_of(request, display, geometry, eye, rays);
        const Geometry there = resolve(seen);
        Image content = eye.picture ? *eye.picture : request.content_of(seen, there, samples, quiet);
        Display white_view = seen;
        white_view.render.samples = white_points;
        RenderOptions options;
        options.threads = request.threads;  // which eyes and tiles share
        options.device = "cpu";
        Rendering bright = render(white_view, there, white, options, quiet);
        if (request.job.cancelled()) return;
        made[k] =
            View{ViewRows(seen, there), eye.weight, std::move(content), std::move(bright.image), elements_across_lens(seen, there)};
        request.job.advance(1);
    });
    std::vector<View> views;
    for (std::optional<View>& view : made) {
        if (!view) return {};
        views.push_back(std::move(*view));
    }
    return views;
}

double gain_of(const Request& request, std::span<const View> views) {
    std::vector<float> light;
    for (const View& view : views) {
        if (view.weight != 1) continue;
        const WhiteLight white(view);
        for (std::size_t p = 0; p < white.here.size(); ++p)
            if (white.here[p] >= float(whole_share) * white.nearby[p]) light.push_back(white.here[p]);
    }
    const float brightest = light.empty() ? 0 : *std::max_element(light.begin(), light.end());
    std::erase_if(light, [&](float x) { return !(x >= float(dim_share) * brightest) || !(x > 0); });
    if (light.empty()) throw no_light(request);
    const auto middle = light.begin() + std::ptrdiff_t(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    return *middle;
}

void expect_light(std::vector<View>& views, double gain) {
    for (View& view : views) {
        const WhiteLight white(view);
        view.expected.assign(white.here.size(), 0);
        for (std::size_t p = 0; p < white.here.size(); ++p) {
            float* const content = &view.content.rgb[3 * p];
            if (std::isnan(content[0])) {  // unknown_light
                std::fill_n(content, 3, 0.f);
                continue;
            }
            if (!(white.nearby[p] > float(least_light * gain))) continue;
            const float share = white.here[p] / white.nearby[p];
            if (share > float(least_share)) view.expected[p] = share > float(whole_share) ? 1 : share;
        }
    }
}

}  // namespace lfdsim
