#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "render/acoustics/scattering.h"
#include "render/paths/chain_spread.h"
#include "render/paths/searches.h"

namespace echoloop {
namespace {

constexpr std::size_t most_images = 64, most_mirrors = FewPlanes::most, most_order = 5;
constexpr std::size_t most_spread = 4;  ///< of the loudest, that go through the pattern of a single beam
constexpr int most_tries = 20'000;      ///< sequences of mirrors in one ping
constexpr double square_cosine =
    0.0175;  ///< faces this near to a right angle are corners, which have their own search
constexpr std::size_t no_outline = ~std::size_t{0};
constexpr double least_length2 = 4e-4;  ///< m^2: a path of 2 cm, there and back
constexpr double faintest_part =
    1e-6;  ///< of a chain's power: coherent or incoherent parts below are left out

/// Sound that goes from mirror to mirror is sent back by one of them only. A sediment's facets are not in its
/// echo (Material::lobe), so they send no more back here: this is the share of their lobe at right angles
/// that its constant or curve holds, at most 1. Without it a second bottom was 5 dB below the first of sand,
/// where an Imagenex 852 recorded at least 12.8 dB.
double sent_back_by(Material material, double wavenumber) {
    if (material.lobe) return 1;
    const double constant = std::pow(10, backscatter_db(material, std::numbers::pi / 2) / 10);
    material.lobe = true, material.backscatter.clear();
    const double lobe = facet_lobe(material, wavenumber, 1);
    return lobe > constant ? constant / lobe : 1;
}

/// A plane that takes part in paths.
struct ImageMirror {
    std::size_t face = no_outline;  ///< of Mirrors, or a plane without end
    Vec3 normal;
    double offset = 0;
    double reflection = 0, roughness = 0, slope = 0;
    bool incoherent = false;  ///< whatever the roughness: a curved mesh
    double sent_back = 1;     ///< see sent_back_by()
    bool is_water = false;    ///< the water's surface, below which there are bubbles
    double loudest = 0;       ///< uPa, of its own echo
};

/// A path by several mirrors and back, before anybody has looked whether something is in its way.
struct ImagePath {
    std::array<Vec3, most_order> points{};  ///< in the order in which sound meets the mirrors
    std::array<const ImageMirror*, most_order> mirrors{};
    std::size_t order = 0;
    double range = 0;  ///< m, half its length
    FanDirection leaves, arrives;
    double smooth = 0;    ///< uPa, with its patterns, if all mirrors were smooth
    double coherent = 1;  ///< share of the power that stays so
    std::complex<double> share{1};

    double power() const {
        return smooth * smooth * std::max(coherent * std::norm(share), 0.1 * (1 - coherent));
    }
};

class ImageSearch {
  public:
    ImageSearch(const PathPing& ping, const Mirrors& mirrors) : ping_(ping), mirrors_(mirrors) {}

    void run(std::span<const std::size_t> faces, std::vector<TargetEcho>& targets,
             std::vector<PathEcho>& diffuse) {
        find_mirrors(faces);
        prepare_planes();
        images_[0] = ping_.sonar;
        grow(0, 1, 0, ~0U);
        std::ranges::stable_sort(paths_, std::greater{}, [](const ImagePath& p) { return p.power(); });
        if (paths_.size() > most_images) paths_.resize(most_images);
        for (const ImagePath& path : paths_)
            if (is_free(path)) add(path, targets, diffuse);
    }

  private:
    void find_mirrors(std::span<const std::size_t> faces) {
        for (const std::size_t face : faces) {
            const MirrorFace& plane = mirrors_.faces()[face];
            const Material& material = mirrors_.material(face);
            ImageMirror mirror{
                face, plane.normal, plane.offset, material.reflection, material.roughness, material.slope};
            mirror.sent_back = sent_back_by(material, ping_.wavenumber);
            add_mirror(mirror);
        }
        if (const auto surface = ping_.space.surface_above(ping_.sonar)) {
            ImageMirror mirror{no_outline, {0, 0, -1},         -surface->height,
                               -1,         surface->roughness, surface->slope};
            mirror.is_water = true;
            add_mirror(mirror);
            add_curved_bottom();
        }
        std::ranges::stable_sort(all_, std::greater{}, &ImageMirror::loudest);
        if (all_.size() > most_mirrors) all_.resize(most_mirrors);
    }

    /// A level plane for the curved mesh below, so that its echo comes back from the surface once more.
    void add_curved_bottom() {
        const auto met = ping_.space.meet(ping_.sonar, {0, 0, -1}, ping_.end_range);
        if (!met || met->material == nullptr || !(met->material->mesh_slope > 0)) return;
        const Material& material = *met->material;
        ImageMirror bottom{no_outline,         {0, 0, 1},
                           met->point.z,       material.reflection,
                           material.roughness, std::hypot(material.slope, material.mesh_slope)};
        bottom.incoherent = true;
        bottom.sent_back = sent_back_by(material, ping_.wavenumber);
        add_mirror(bottom);
    }

    void add_mirror(ImageMirror mirror) {
        const double range = std::abs(dot(mirror.normal, ping_.sonar) - mirror.offset);
        if (!(range > 1e-2) || range >= ping_.end_range) return;
        mirror.loudest = ping_.arrival(range, range) * range / 2 * std::abs(mirror.reflection);
        if (mirror.loudest > ping_.least) all_.push_back(mirror);
    }

    double level_at(double range) const { return ping_.arrival(range, range) * range / 2; }

    /// What is asked of every mirror again and again.
    void prepare_planes() {
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const ImageMirror& mirror = all_[i];
            planes_.x[i] = mirror.normal.x, planes_.y[i] = mirror.normal.y, planes_.z[i] = mirror.normal.z;
            planes_.offset[i] = mirror.offset;
            planes_.before[i] = dot(mirror.normal, ping_.sonar) - mirror.offset;
            if (mirror.face != no_outline && mirrors_.material(mirror.face).double_sided)
                both_sides_ |= 1U << i;
            for (std::size_t k = 0; k < all_.size(); ++k)
                if (k != i && std::abs(dot(all_[k].normal, mirror.normal)) >= square_cosine)
                    after_[i] |= 1U << k;
        }
    }

    /// `reflections`: the product of those so far. `distance2`: m^2, from the sonar to its image so far.
    /// `allowed`: the mirrors that may come next, as bits.
    void grow(std::size_t order, double reflections, double distance2, unsigned allowed) {
        const Vec3 image = images_[order];
        double before[most_mirrors], next2[most_mirrors];
        reflect(planes_, image, distance2, before, next2);
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (++tries_ > most_tries) return;
            const double ahead = (both_sides_ >> i & 1U) != 0 ? std::abs(before[i]) : before[i];
            if (!(ahead > 1e-6) || (allowed >> i & 1U) == 0) continue;
            if (next2[i] < least_length2 || next2[i] >= 4 * ping_.end_range * ping_.end_range) continue;
            sequence_[order] = &all_[i], images_[order + 1] = image - 2 * before[i] * all_[i].normal;
            const bool crosses = order > 0 && find_points(order + 1);
            if (!crosses && order + 1 == most_order) continue;
            const double range = std::sqrt(next2[i]) / 2, product = reflections * all_[i].reflection;
            const double level = level_at(range);
            if (!(level * std::abs(product) > ping_.least)) continue;
            if (crosses) try_path(order + 1, range, level * product);
            if (order + 1 < most_order) grow(order + 1, product, next2[i], after_[i]);
        }
    }

    /// Goes the path of the sequence back from its last image: fills points_ and cosines_, or returns false
    /// where it crosses no mirror at its place.
    bool find_points(std::size_t order) {
        Vec3 to = ping_.sonar;
        for (std::size_t i = order; i-- > 0;) {
            const ImageMirror& mirror = *sequence_[i];
            const Vec3 line = images_[i + 1] - to;
            const double slope = dot(line, mirror.normal);
            const double share = (mirror.offset - dot(to, mirror.normal)) / slope;
            if (!(share > 1e-9 && share < 1 - 1e-9)) return false;
            to = to + share * line;
            if (mirror.face != no_outline && !mirrors_.is_near(mirror.face, to)) return false;
            points_[i] = to, slopes_[i] = slope * slope / dot(line, line);
        }
        return true;
    }

    /// `smooth`: uPa, if all mirrors were smooth and the pattern were 1.
    void try_path(std::size_t order, double range, double smooth) {
        ImagePath path;
        path.order = order, path.range = range, path.points = points_;
        double left = 2 * range, bubbles = 1;
        Vec3 to = ping_.sonar;
        for (std::size_t i = order; i-- > 0;) {
            const ImageMirror& mirror = *sequence_[i];
            path.mirrors[i] = &mirror;
            left -= norm(path.points[i] - to);
            to = path.points[i];
            if (mirror.face == no_outline) continue;
            const Foot foot = mirrors_.foot(
                mirror.face, to, mirror_zone(ping_.wavenumber, left, 2 * range - left, ping_.resolution));
            if (foot.outside > 0) return;
            path.share *= foot.share;
        }
        for (std::size_t i = order; i-- > 0;) {
            const ImageMirror& mirror = *sequence_[i];
            const double cosine = std::sqrt(slopes_[i]);
            const double loss =
                mirror.incoherent ? 0 : coherent_loss(ping_.wavenumber, mirror.roughness, cosine);
            path.coherent *= loss * loss;
            if (mirror.is_water) bubbles *= ping_.space.bubble_loss(cosine);
        }
        path.leaves = seen(path.points[0]);
        path.arrives = ping_.received(seen(path.points[order - 1]), range);
        path.smooth = smooth * bubbles * path.leaves.transmit * path.arrives.receive;
        if (!(path.power() > ping_.least * ping_.least)) return;
        if (ping_.rays != nullptr) path.range = sounding(path) / 2;
        paths_.push_back(path);
    }

    /// m, of the whole path.
    double sounding(const ImagePath& path) const {
        double length =
            ping_.leg(ping_.sonar, path.points[0]) + ping_.leg(path.points[path.order - 1], ping_.sonar);
        for (std::size_t i = 1; i < path.order; ++i) length += ping_.leg(path.points[i - 1], path.points[i]);
        return length;
    }

    FanDirection seen(Vec3 point) const {
        return ping_.seen(1 / norm(point - ping_.sonar) * (point - ping_.sonar));
    }

    bool is_free(const ImagePath& path) const {
        Vec3 from = ping_.sonar;
        for (std::size_t i = 0; i <= path.order; ++i) {
            const Vec3 to = i < path.order ? path.points[i] : ping_.sonar;
            if (ping_.space.blocked(from, to)) return false;
            from = to;
        }
        return true;
    }

    void add(const ImagePath& path, std::vector<TargetEcho>& targets, std::vector<PathEcho>& diffuse) {
        const double power = path.smooth * path.smooth;
        if (path.coherent > faintest_part) {
            const double phase = 2 * ping_.wavenumber * path.range + std::arg(path.share) +
                                 (path.smooth < 0 ? std::numbers::pi : 0);
            targets.push_back({path.range, power * path.coherent * std::norm(path.share),
                               std::remainder(phase, 2 * std::numbers::pi), path.arrives.bearing,
                               static_cast<int>(path.order), path.arrives.elevation, path.arrives.turned});
        }
        if (1 - path.coherent > faintest_part) add_chain(path, power * (1 - path.coherent), diffuse);
    }

    /// The incoherent part, over the range by which its paths are longer and, for a fan, over its bearings.
    void add_chain(const ImagePath& path, double power, std::vector<PathEcho>& diffuse) {
        std::array<ChainMirror, most_order> mirrors{};
        double at = 0, sent_back = 1;
        Vec3 from = ping_.sonar;
        for (std::size_t i = 0; i < path.order; ++i) {
            at += norm(path.points[i] - from), from = path.points[i];
            const ImageMirror& mirror = *path.mirrors[i];
            const bool is_smooth = !mirror.incoherent && mirror.roughness == 0;
            mirrors[i] = {at / (2 * path.range), is_smooth ? 0 : mirror.slope};
            sent_back = std::min(sent_back, mirror.sent_back);
        }
        const auto chain = std::span(mirrors).first(path.order);
        constexpr double everywhere = std::numeric_limits<double>::infinity();
        const double per_width = 1 / (2 * std::sqrt(std::numbers::ln2));  // of exp(-x^2 / spread^2) at half
        const Shot& shot = ping_.shot;
        const bool one_beam = shot.beams() == 1, rows = shot.rows() > 1;
        const ChainShare across = chain_share(chain, one_beam ? shot.beam_width * per_width : everywhere),
                         up = chain_share(chain, rows ? everywhere : shot.fan_height * per_width);
        if (one_beam && !rows && spread_ < most_spread &&
            (across.variance + up.variance) * path.range > ping_.resolution) {
            const double patterns = path.leaves.transmit * path.arrives.receive;
            const RoughChain rough{chain, path.range, path.leaves, path.arrives,
                                   power * sent_back / (patterns * patterns)};
            if (add_through_pattern(ping_, rough, spread_, diffuse)) {
                ++spread_;
                return;
            }
        }
        PathEcho echo;
        echo.elevation = static_cast<float>(path.arrives.elevation);
        echo.turned = static_cast<float>(path.arrives.turned);
        const double whole = power * sent_back * across.power * up.power, spread = std::sqrt(across.variance);
        echo.width = static_cast<float>(3.5 * spread),
        echo.height = static_cast<float>(3.5 * std::sqrt(up.variance));
        // One each half beam, so that no beam between them stays dark.
        constexpr int most_parts = 513;
        const int parts =
            one_beam || rows ? 1
                             : std::clamp(static_cast<int>(12 * spread / shot.beam_width) | 1, 1, most_parts);
        const auto off_of = [&](int part) { return (part - (parts - 1) / 2.0) * 6 / parts; };  // in spreads
        const auto weight_of = [](double off) { return std::exp(-off * off / 2); };
        double sum = 0;
        for (int part = 0; part < parts; ++part) sum += weight_of(off_of(part));
        for (int part = 0; part < parts; ++part) {
            const double off = off_of(part);
            // What arrives by an angle x beside the axis has come farther by x^2 / 2 of its way; how much
            // farther by facets in between is the whole spread at every angle (own choice).
            const double near = parts > 1 ? off * off * across.variance / 2 : 0;
            echo.near_range = static_cast<float>(path.range * (1 + near));
            echo.far_range = static_cast<float>(path.range * (1 + near + across.variance + up.variance));
            echo.bearing = static_cast<float>(path.arrives.bearing + off * spread);
            echo.power = static_cast<float>(whole * weight_of(off) / sum);
            if (std::isnormal(echo.power)) diffuse.push_back(echo);
        }
    }

    const PathPing& ping_;
    const Mirrors& mirrors_;
    std::vector<ImageMirror> all_;
    FewPlanes planes_;                            ///< of them
    std::array<unsigned, most_mirrors> after_{};  ///< mirrors that may come next, as bits
    unsigned both_sides_ = 0;                     ///< those that are there from both, likewise
    std::array<const ImageMirror*, most_order> sequence_{};
    std::array<Vec3, most_order + 1> images_{};  ///< of the sonar in the mirrors of the sequence so far
    std::array<Vec3, most_order> points_{};      ///< as ImagePath's, of the sequence so far
    std::array<double, most_order> slopes_{};    ///< squares of the cosines of incidence there
    std::vector<ImagePath> paths_;
    std::size_t spread_ = 0;  ///< chains that went through the pattern of a single beam
    int tries_ = 0;
};

}  // namespace

void find_image_echoes(const PathPing& ping, const Mirrors& mirrors, std::span<const std::size_t> faces,
                       std::vector<TargetEcho>& targets, std::vector<PathEcho>& diffuse) {
    ImageSearch(ping, mirrors).run(faces, targets, diffuse);
}

}  // namespace echoloop
