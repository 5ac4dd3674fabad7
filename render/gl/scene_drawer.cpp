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

}  // namespace

struct SceneDrawer::BentDrawing {
    explicit BentDrawing(const Functions& gl)
        : program(gl, bent_vertex_shader, fan_fragment_shader),
          table(gl),
          patches{Patches(gl), Patches(gl)} {}

    Program program;
    Uniforms uniforms;
    FloatTexture table;
    std::shared_ptr<const RayTable> rays;  ///< in the table
    struct Patches {
        explicit Patches(const Functions& gl) : array(gl) {}
        VertexArray array;
        std::unique_ptr<Buffer> vertices, indices;
        std::uint64_t version = 0;  ///< of the split mesh
    };
    std::array<Patches, 2> patches;  ///< as SplitScene::mesh()
};

SceneDrawer::SceneDrawer(std::unique_ptr<Context> context, std::shared_ptr<const Scene> scene)
    : context_(std::move(context)), scene_(std::move(scene)), gl_(current(*context_)) {
    program_ = std::make_unique<Program>(gl_, fan_vertex_shader, fan_fragment_shader);
    straight_uniforms_ = uniforms_of(*program_);
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
    const auto vertices = scene_->all_vertices();
    vertices_ = std::make_unique<Buffer>(gl_, GL_ARRAY_BUFFER, vertices.data(), vertices.size_bytes());
    set_vertex_layout(gl_);
    const auto indices = scene_->all_indices();
    indices_ = std::make_unique<Buffer>(gl_, GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size_bytes());
}

void SceneDrawer::set_view(const View& view, const SeenNodes& part, SampleOffsets offset) const {
    const Pose& frame_from_fan = part.frame_from_fan;
    const Quat q = frame_from_fan.orientation * view.fan_from_view();
    const Vec3 axes[3] = {rotate(q, {0, -1, 0}), rotate(q, {0, 0, 1}), rotate(q, {1, 0, 0})};
    GLfloat rows[9];
    for (std::size_t i = 0; i < 3; ++i) {
        rows[3 * i] = static_cast<float>(axes[i].x);
        rows[3 * i + 1] = static_cast<float>(axes[i].y);
        rows[3 * i + 2] = static_cast<float>(axes[i].z);
    }
    gl_.UniformMatrix3fv(uniforms_.view_from_world, 1, GL_TRUE, rows);
    if (bends_)
        gl_.Uniform3f(uniforms_.up, static_cast<float>(dot(axes[0], part.up)),
                      static_cast<float>(dot(axes[1], part.up)), static_cast<float>(dot(axes[2], part.up)));
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

SceneDrawer::Uniforms SceneDrawer::uniforms_of(const Program& program) const {
    return {program.uniform("view_from_world"),
            program.uniform("eye"),
            program.uniform("window"),
            program.uniform("pixel"),
            program.uniform("up"),
            program.uniform("columns"),
            program.uniform("rows")};
}

void SceneDrawer::begin_straight() {
    bends_ = false;
    program_->use();
    uniforms_ = straight_uniforms_;
}

void SceneDrawer::begin_bent(const Bending& bending) {
    bends_ = true;
    if (!bent_) {
        bent_ = std::make_unique<BentDrawing>(gl_);
        bent_->uniforms = uniforms_of(bent_->program);
        array_->bind();
    }
    bent_->program.use();
    uniforms_ = bent_->uniforms;
    const RayTable& rays = *bending.rays;
    if (bent_->rays != bending.rays)
        bent_->table.fill(static_cast<int>(RayTable::columns), static_cast<int>(RayTable::rows),
                          rays.moves().data());
    bent_->rays = bending.rays;
    bent_->table.bind();
    const RayTable::Rows& rows = rays.row_places();
    constexpr auto across = static_cast<double>(RayTable::columns),
                   deep = static_cast<double>(RayTable::rows);
    const double middle = rows.a / (2 * rows.b);  // u = sqrt(middle^2 + |below| / b) - middle
    gl_.Uniform4f(uniforms_.columns, static_cast<float>(1 / (rays.column_step() * across)),
                  static_cast<float>(0.5 / across), static_cast<float>(1 / deep),
                  static_cast<float>((0.5 - rows.first) / deep));
    gl_.Uniform3f(uniforms_.rows, static_cast<float>(middle * middle), static_cast<float>(1 / rows.b),
                  static_cast<float>(middle));
    for (const bool surround : {false, true}) {
        const SplitMesh& mesh = bending.split->mesh(surround);
        BentDrawing::Patches& to = bent_->patches[surround];
        if (to.version == mesh.version() || mesh.indices().empty()) continue;
        to.version = mesh.version();
        to.array.bind();
        const auto vertices = mesh.vertices();
        to.vertices = std::make_unique<Buffer>(gl_, GL_ARRAY_BUFFER, vertices.data(), vertices.size_bytes());
        set_vertex_layout(gl_);
        const auto indices = mesh.indices();
        to.indices =
            std::make_unique<Buffer>(gl_, GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size_bytes());
        array_->bind();
    }
    if (rays.has_shadow()) gl_.Enable(GL_CLIP_DISTANCE0);
}

void SceneDrawer::draw_patches(const View& view, const SeenNodes& part) {
    bent_->patches[view.surround].array.bind();
    for (const bool double_sided : {false, true}) {
        DrawList& list = lists_[0];
        list.clear();
        for (const SeenPatch& patch : part.patches)
            if (patch.double_sided == double_sided) {
                list.counts.push_back(static_cast<GLsizei>(patch.indices));
                list.offsets.push_back(
                    reinterpret_cast<const void*>(patch.first_index * sizeof(std::uint16_t)));
                list.bases.push_back(static_cast<GLint>(patch.first_vertex));
            }
        submit(list, double_sided);
    }
    array_->bind();
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
void SceneDrawer::clear_target(int width, int height) {
    constexpr int step = 8;  // pixels
    width = (width + step - 1) / step * step;
    height = (height + step - 1) / step * step;
    const auto fits = [&](const SizedTarget& target) {
        return target.width == width && target.height == height;
    };
    const auto make = [&] {
        constexpr std::size_t bytes = 36;  // four floats of colour, twice, and one of depth
        return std::pair(SizedTarget{width, height, std::make_unique<FloatTarget>(gl_, width, height)},
                         static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytes);
    };
    targets_.get(fits, make).target->clear();
}

void SceneDrawer::draw_part(const View& view, const SeenNodes& part, SampleOffsets offset) {
    if (part.nodes.empty() && part.patches.empty()) return;
    for (DrawList& list : lists_) list.clear();
    for (const std::uint32_t node : part.nodes) list(scene_->nodes()[node]);
    set_view(view, part, offset);
    submit(lists_[0], false);
    submit(lists_[1], true);
    if (!part.patches.empty()) draw_patches(view, part);
}

void SceneDrawer::draw_view(const SeenView& seen, SampleOffsets offset) {
    clear_target(static_cast<int>(seen.view->samples), static_cast<int>(seen.view->lines));
    for (const SeenNodes& part : seen.parts) draw_part(*seen.view, part, offset);
    gl_.Finish();  // costs nothing, as the next call would wait, and tells drawing from reading
}

/// Every view on a target of its own size, as llvmpipe clears and walks through all of a target; and where a
/// vertex falls among the pixels is rounded there, whoever draws the other views.
double SceneDrawer::draw(std::span<const SeenView* const> views, std::size_t samples, SampleOffsets offset,
                         Pixel* image, const Bending& bending) {
    context_->make_current();
    bending.rays ? begin_bent(bending) : begin_straight();
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
    if (bends_) gl_.Disable(GL_CLIP_DISTANCE0);
    gl_.check("drawing a fan");
    return read_back;
}

std::string SceneDrawer::description() const {
    return std::string(context_->kind()) + ", " + gl_.description();
}

}  // namespace echoloop::gl
