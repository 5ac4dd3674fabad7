#include "render/gl/scene_drawer.h"

#include <algorithm>
#include <chrono>

#include "render/gl/fan_shader.h"

namespace echoloop::gl {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// By how much a coarse stand-in may be off at most; in the root mean square it is a third of that. Pixels of
/// more than a degree show what side lobes hear: first of all the nearest bottom, whose first return shifts
/// with it, so near stand-ins are finer.
ViewLimits limits_of(const View& view, const Outlook& outlook) {
    const double pixel =
        std::max(view.line_width() * view.usual_width, view.sample_height() * view.usual_height);
    const bool background = outlook.begin_range > 0, coarse = pixel > deg_to_rad(1);
    return {.end_range = outlook.end_range,
            .margin = pixel,
            .tolerance = (background ? 1.5
                          : coarse   ? 1.0
                                     : 0.4) *
                         pixel,
            .full_tolerance_range = coarse && !background ? 0.45 * outlook.end_range : 0,
            .begin_range = outlook.begin_range,
            .hiding_tolerance = 4 * pixel};
}

/// Makes the context current before the members that need it are built.
Context& current(Context& context) {
    context.make_current();
    return context;
}

void set_vertex_layout(const Functions& gl) {
    constexpr GLsizei stride = sizeof(SceneVertex);
    const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
        gl.EnableVertexAttribArray(index);
        gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, stride,
                               reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(SceneVertex, position));
    attribute(1, 3, offsetof(SceneVertex, normal));
    attribute(2, 1, offsetof(SceneVertex, surface));
}

/// Finds what a view sees of the still scene and of every mover: nothing, where all of it would only hide.
void find_seen(const Scene& scene, const Outlook& outlook, SeenView& seen) {
    const ViewLimits limits = limits_of(*seen.view, outlook);
    bool wanted = false;
    const auto find = [&](SeenNodes& to, NodeRange range, const Pose& frame_from_fan) {
        to.frame_from_fan = frame_from_fan;
        wanted |= find_visible(scene, range, *seen.view, frame_from_fan, limits, to.nodes);
    };
    find(seen.parts[0], {0, scene.still_nodes()}, outlook.world_from_fan);
    // Seen from a mover's own frame nothing of it has moved: neither its buffers nor its bounds.
    for (std::size_t m = 0; m < outlook.movers.size(); ++m)
        find(seen.parts[m + 1], {scene.movers()[m].first_node, scene.movers()[m].last_node},
             inverse(outlook.movers[m]) * outlook.world_from_fan);
    seen.triangles = seen.chunks = 0;
    for (SeenNodes& part : seen.parts) {
        if (!wanted) part.nodes.clear();
        seen.chunks += part.nodes.size();
        for (const std::uint32_t node : part.nodes) seen.triangles += scene.nodes()[node].indices / 3;
    }
}

}  // namespace

void find_seen(const Scene& scene, const Picture& picture, const Outlook& outlook,
               std::vector<SeenView>& seen) {
    seen.resize(picture.views.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        seen[i].view = &picture.views[i];
        seen[i].parts.resize(1 + outlook.movers.size());
        find_seen(scene, outlook, seen[i]);
    }
}

SceneDrawer::SceneDrawer(std::unique_ptr<Context> context, std::shared_ptr<const Scene> scene)
    : context_(std::move(context)), scene_(std::move(scene)), gl_(current(*context_)) {
    program_ = std::make_unique<Program>(gl_, fan_vertex_shader, fan_fragment_shader);
    uniforms_ = {program_->uniform("view_from_world"), program_->uniform("eye"), program_->uniform("window"),
                 program_->uniform("pixel")};
    array_ = std::make_unique<VertexArray>(gl_);
    upload();
    gl_.check("upload of the scene");
}

/// The objects below die with their own context current, whichever was used last.
SceneDrawer::~SceneDrawer() {
    try {
        context_->make_current();
    } catch (const std::exception&) {
        return;
    }
}

void SceneDrawer::upload() {
    for (const SceneSurface& surface : scene_->surfaces()) {
        material_of_surface_.push_back(surface.material);
        object_of_surface_.push_back(surface.object);
    }
    const auto vertices = scene_->all_vertices();
    vertices_ = std::make_unique<Buffer>(gl_, GL_ARRAY_BUFFER, vertices.data(), vertices.size_bytes());
    set_vertex_layout(gl_);
    const auto indices = scene_->all_indices();
    indices_ = std::make_unique<Buffer>(gl_, GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size_bytes());
}

void SceneDrawer::set_view(const View& view, const Pose& frame_from_fan, SampleOffsets offset) const {
    const Quat q = frame_from_fan.orientation * view.fan_from_view();
    const Vec3 axes[3] = {rotate(q, {0, -1, 0}), rotate(q, {0, 0, 1}), rotate(q, {1, 0, 0})};
    GLfloat rows[9];
    for (std::size_t i = 0; i < 3; ++i) {
        rows[3 * i] = static_cast<float>(axes[i].x);
        rows[3 * i + 1] = static_cast<float>(axes[i].y);
        rows[3 * i + 2] = static_cast<float>(axes[i].z);
    }
    gl_.UniformMatrix3fv(uniforms_.view_from_world, 1, GL_TRUE, rows);
    const Vec3 eye = frame_from_fan.position;
    gl_.Uniform3f(uniforms_.eye, static_cast<float>(eye.x), static_cast<float>(eye.y),
                  static_cast<float>(eye.z));
    const PixelOffset moved = offset.of(view);
    const double x = (view.left + view.right) / 2 + moved.line * view.line_width();
    const double y = (view.bottom + view.top) / 2 - moved.sample * view.sample_height();
    gl_.Uniform4f(uniforms_.window, static_cast<float>(x), static_cast<float>(y),
                  static_cast<float>(2 / (view.right - view.left)),
                  static_cast<float>(2 / (view.top - view.bottom)));
    gl_.Uniform4f(uniforms_.pixel, static_cast<float>(view.line_width()),
                  static_cast<float>(view.sample_height()), static_cast<float>(view.usual_width),
                  static_cast<float>(view.usual_height));
    gl_.Viewport(0, 0, static_cast<GLsizei>(view.samples), static_cast<GLsizei>(view.lines));
}

void SceneDrawer::DrawList::clear() {
    counts.clear();
    offsets.clear();
    bases.clear();
}

void SceneDrawer::list(const SceneNode& node) {
    const std::size_t vertex = node.coarse ? scene_->vertices().size() : 0;
    const std::size_t index = node.coarse ? scene_->indices().size() : 0;
    DrawList& to = lists_[scene_->materials()[node.material].double_sided ? 1 : 0];
    to.counts.push_back(static_cast<GLsizei>(node.indices));
    to.offsets.push_back(reinterpret_cast<const void*>((index + node.first_index) * sizeof(std::uint16_t)));
    to.bases.push_back(static_cast<GLint>(vertex + node.first_vertex));
}

void SceneDrawer::submit(const DrawList& list, bool double_sided) const {
    if (list.counts.empty()) return;
    double_sided ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
    gl_.MultiDrawElementsBaseVertex(GL_TRIANGLES, list.counts.data(), GL_UNSIGNED_SHORT, list.offsets.data(),
                                    static_cast<GLsizei>(list.counts.size()), list.bases.data());
}

/// Views of nearly the same size share a target.
void SceneDrawer::bind_target(int width, int height) {
    constexpr int step = 8;  // pixels
    width = (width + step - 1) / step * step;
    height = (height + step - 1) / step * step;
    const auto fits = [&](const SizedTarget& target) {
        return target.width == width && target.height == height;
    };
    const auto make = [&] {
        constexpr std::size_t bytes = 20;  // four floats of colour and one of depth
        return std::pair(SizedTarget{width, height, std::make_unique<FloatTarget>(gl_, width, height)},
                         static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytes);
    };
    targets_.get(fits, make).target->bind();
}

void SceneDrawer::draw_part(const View& view, const SeenNodes& part, SampleOffsets offset) {
    if (part.nodes.empty()) return;
    for (DrawList& list : lists_) list.clear();
    for (const std::uint32_t node : part.nodes) list(scene_->nodes()[node]);
    set_view(view, part.frame_from_fan, offset);
    submit(lists_[0], false);
    submit(lists_[1], true);
}

void SceneDrawer::draw_view(const SeenView& seen, SampleOffsets offset) {
    bind_target(static_cast<int>(seen.view->samples), static_cast<int>(seen.view->lines));
    const GLfloat nothing[4] = {0, 0, 0, 0};  // surface 0, and the depth of infinity
    gl_.ClearBufferfv(GL_COLOR, 0, nothing);
    gl_.ClearBufferfv(GL_DEPTH, 0, nothing);
    for (const SeenNodes& part : seen.parts) draw_part(*seen.view, part, offset);
    gl_.Finish();  // costs nothing, as the next call would wait, and tells drawing from reading
}

/// Every view on a target of its own size, as llvmpipe clears and walks through all of a target; and where a
/// vertex falls among the pixels is rounded there, whoever draws the other views.
double SceneDrawer::draw(std::span<const SeenView* const> views, std::size_t samples, SampleOffsets offset,
                         Pixel* image) {
    context_->make_current();
    program_->use();
    gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(samples));
    double read_back = 0;
    for (const SeenView* seen : views) {
        const View& view = *seen->view;
        draw_view(*seen, offset);
        const auto drawn = Clock::now();
        gl_.ReadPixels(0, 0, static_cast<GLsizei>(view.samples), static_cast<GLsizei>(view.lines), GL_RGBA,
                       GL_FLOAT, image + view.first_line * samples);
        read_back += seconds_since(drawn);
    }
    gl_.check("drawing a fan");
    return read_back;
}

std::string SceneDrawer::description() const {
    return std::string(context_->kind()) + ", " + gl_.description();
}

}  // namespace echoloop::gl
