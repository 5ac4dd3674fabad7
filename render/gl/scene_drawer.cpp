#include "render/gl/scene_drawer.h"

#include "render/fan/culling.h"
#include "render/gl/fan_shader.h"

namespace echoloop::gl {
namespace {

struct GpuVertex {
    SceneVertex vertex;
    float surface;
};

/// Makes the context current before the members that need it are built.
Context& current(Context& context) {
    context.make_current();
    return context;
}

void set_vertex_layout(const Functions& gl) {
    constexpr GLsizei stride = sizeof(GpuVertex);
    const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
        gl.EnableVertexAttribArray(index);
        gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, stride,
                               reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(GpuVertex, vertex.position));
    attribute(1, 3, offsetof(GpuVertex, vertex.normal));
    attribute(2, 1, offsetof(GpuVertex, surface));
}

}  // namespace

SceneDrawer::SceneDrawer(std::unique_ptr<Context> context, std::shared_ptr<const Scene> scene)
    : context_(std::move(context)), scene_(std::move(scene)), gl_(current(*context_)) {
    program_ = std::make_unique<Program>(gl_, fan_vertex_shader, fan_fragment_shader);
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
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> surfaces;  // of object and material
    std::vector<GpuVertex> vertices;
    vertices.reserve(scene_->vertices().size());
    for (const SceneChunk& chunk : scene_->chunks()) {
        const auto [entry, added] =
            surfaces.try_emplace({chunk.object, chunk.material}, static_cast<std::uint32_t>(surfaces.size()));
        if (added) material_of_surface_.push_back(chunk.material);
        for (const SceneVertex& vertex : scene_->vertices().subspan(chunk.first_vertex, chunk.vertices))
            vertices.push_back({vertex, static_cast<float>(entry->second + 1)});
    }
    vertices_ =
        std::make_unique<Buffer>(gl_, GL_ARRAY_BUFFER, vertices.data(), vertices.size() * sizeof(GpuVertex));
    set_vertex_layout(gl_);
    indices_ = std::make_unique<Buffer>(gl_, GL_ELEMENT_ARRAY_BUFFER, scene_->indices().data(),
                                        scene_->indices().size_bytes());
}

void SceneDrawer::set_view(const View& view, const Pose& world_from_fan, PixelOffset offset) const {
    const Quat q = world_from_fan.orientation * view.fan_from_view();
    const Vec3 axes[3] = {rotate(q, {0, -1, 0}), rotate(q, {0, 0, 1}), rotate(q, {1, 0, 0})};
    GLfloat rows[9];
    for (std::size_t i = 0; i < 3; ++i) {
        rows[3 * i] = static_cast<float>(axes[i].x);
        rows[3 * i + 1] = static_cast<float>(axes[i].y);
        rows[3 * i + 2] = static_cast<float>(axes[i].z);
    }
    gl_.UniformMatrix3fv(program_->uniform("view_from_world"), 1, GL_TRUE, rows);
    const Vec3 eye = world_from_fan.position;
    gl_.Uniform3f(program_->uniform("eye"), static_cast<float>(eye.x), static_cast<float>(eye.y),
                  static_cast<float>(eye.z));
    const double x = (view.left + view.right) / 2 + offset.line * view.line_width();
    const double y = (view.bottom + view.top) / 2 - offset.sample * view.sample_height();
    gl_.Uniform4f(program_->uniform("window"), static_cast<float>(x), static_cast<float>(y),
                  static_cast<float>(2 / (view.right - view.left)),
                  static_cast<float>(2 / (view.top - view.bottom)));
    gl_.Uniform2f(program_->uniform("pixel"), static_cast<float>(view.line_width()),
                  static_cast<float>(view.sample_height()));
    gl_.Viewport(0, static_cast<GLint>(view.first_line), static_cast<GLsizei>(view.samples),
                 static_cast<GLsizei>(view.lines));
}

void SceneDrawer::draw_chunks(const std::vector<std::uint32_t>& chunks, bool double_sided) const {
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    std::vector<GLint> bases;
    for (const std::uint32_t index : chunks) {
        const SceneChunk& chunk = scene_->chunks()[index];
        if (scene_->materials()[chunk.material].double_sided != double_sided) continue;
        counts.push_back(static_cast<GLsizei>(chunk.indices));
        offsets.push_back(reinterpret_cast<const void*>(chunk.first_index * sizeof(std::uint16_t)));
        bases.push_back(static_cast<GLint>(chunk.first_vertex));
    }
    if (counts.empty()) return;
    double_sided ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
    gl_.MultiDrawElementsBaseVertex(GL_TRIANGLES, counts.data(), GL_UNSIGNED_SHORT, offsets.data(),
                                    static_cast<GLsizei>(counts.size()), bases.data());
}

void SceneDrawer::bind_target(int width, int height) {
    constexpr std::size_t most_targets = 8;  // as many fans as take turns on one renderer
    const auto found = targets_.find({width, height});
    if (found != targets_.end()) return found->second->bind();
    if (targets_.size() == most_targets) targets_.clear();
    targets_[{width, height}] = std::make_unique<FloatTarget>(gl_, width, height);
}

void SceneDrawer::draw(const FanPlan& plan, const Pose& world_from_fan, double end_range, PixelOffset offset,
                       std::vector<Pixel>& pixels) {
    context_->make_current();
    const int width = static_cast<int>(plan.samples), height = static_cast<int>(plan.image_lines);
    bind_target(width, height);
    program_->use();
    gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_GREATER);
    const GLfloat nothing[4] = {0, 0, 0, 0};  // surface 0, and the depth of infinity
    gl_.ClearBufferfv(GL_COLOR, 0, nothing);
    gl_.ClearBufferfv(GL_DEPTH, 0, nothing);
    for (const View& view : plan.views) {
        set_view(view, world_from_fan, offset);
        const double margin = std::max(view.line_width(), view.sample_height());
        const auto chunks = visible_chunks(*scene_, view, world_from_fan, end_range, margin);
        draw_chunks(chunks, false);
        draw_chunks(chunks, true);
    }
    pixels.resize(plan.image_lines * plan.samples);
    gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    gl_.check("drawing a fan");
}

std::string SceneDrawer::description() const {
    return std::string(context_->kind()) + ", " + gl_.description();
}

}  // namespace echoloop::gl
