// The blur of what is shown at a depth, by paraxial theory. Floor 3.
#pragma once
#include "analysis/core/channel_pixels.h"
#include "analysis/core/subject.h"
#include "analysis/resolution/edge_view.h"
#include "analysis/spots/aperture_wave.h"
#include "geometry/diffuser_profile.h"

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace lfdsim {

/// Width of the image of a panel pixel by the nodal points, in the plane z_mm from the panel: a |z - z_H'| / g.
double pixel_image_mm(const Display&, const Geometry&, double z_mm);

/// Whether a plane at this height above the panel is the lenses' own, where each of them shows only one point.
bool at_the_lenses(const Display&, const Geometry&, double z_mm);

/// Half a cycle per jump from lens to lens, as an eye at an angle projects it into a plane z_mm from the panel.
double lens_limit_per_mm(const Subject&, const Direction&, double z_mm, double angle_deg);

/// Half a cycle per image of a panel pixel. Along the direction that is resolved its images follow each other as pixels do along
/// the panel's rows or, where those are nearer to it, columns. Infinite in the lenses' own plane.
double pixel_limit_per_mm(const Subject&, const Direction&, double z_mm);

/// Those of such limits that a plot shows: NaN where one is above four times the lenses' limit in their own plane. The lenses'
/// limit has no bound at L, the pixels' none at the lenses.
std::vector<double> limits_to_plot(std::vector<double> limits, double at_lenses);

/// The distance in a plane between a line of sight and the nodal line of the pixel that it sees: a sum of independent parts.
struct Blur {
    double pixel_mm;                    // of what shines of a pixel: uniform over a square
    ApertureShape aperture;             // the lens's spot is uniform over this ...
    double defocus;                     // ... times this, |1 - z/L|
    double array_rad;                   // the turn of the aperture's axes
    std::array<double, 2> diffuser_mm;  // along x and y: full widths, at half maximum if gaussian
    const ProfileFigures* profile;      // the diffuser's

    /// Modulation at a frequency per mm, 0 or more, along a direction.
    double mtf(double per_mm, const Direction&) const;
    /// The mean of exp(2 pi i nu off) over all parts but the pixel, times that over the pixel.
    std::complex<double> wave(std::complex<double> pixel, double per_mm, const Direction&) const;
    /// About the full width of an edge's blur.
    double width_mm(const Direction&) const;
};

/// Share of the light that an eye at this angle and distance sees on other lenses' elemental images, which Blur leaves out.
double light_astray(const Subject&, double angle_deg, double distance_mm);

/// The blur at an angle of view to the right.
Blur blur(const Display&, const Geometry&, const Theory&, double z_mm, double angle_deg);

/// The blur of one channel, in light of its wavelengths, of content that is made for green light.
class ChannelBlur {
  public:
    ChannelBlur(const Subject&, std::size_t channel, double z_mm, double angle_deg);
    /// The mean of exp(2 pi i nu off), off the distance from the point looked at to the one shown.
    std::complex<double> wave(double per_mm, const Direction&) const;
    /// The mean distance.
    double middle_mm(const Direction&) const;
    /// Width of the image of the channel's narrowest rectangle.
    double narrowest_mm(const Direction& d) const { return std::abs(image_) * pixels_.narrowest(d.x, d.y); }

  private:
    /// The blur of the light at one wavelength.
    struct BlurPath {
        double weight;
        Blur blur;                         // of a lens in this light
        std::array<double, 2> lateral_mm;  // full widths along x' and y': off differs from lens to lens
        std::array<double, 2> middle_mm;   // along x and y
    };
    std::vector<BlurPath> paths_;
    ChannelPixels pixels_;
    double image_;  // of a panel pixel, negative behind the lenses
};

}  // namespace lfdsim
