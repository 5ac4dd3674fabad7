// The shaders that draw one view of a fan. Each pixel gets range, cos(incidence), range footprint and
// surface.
#pragma once

namespace echoloop::gl {

/// Attributes: 0 position (world), 1 normal (world), 2 surface number. The image is transposed: clip x runs
/// along falling elevation, clip y along bearing. Depth is near / distance along the view's axis, so 1 is
/// nearest.
inline constexpr const char* fan_vertex_shader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float surface;
uniform mat3 view_from_world;  // rows: starboard, up, forward
uniform vec3 eye;
uniform vec4 window;           // centre x, centre y, 2 / width, 2 / height on the image plane
out vec3 seen;                 // m: starboard, up, forward
out vec3 seen_normal;
flat out float seen_surface;
const float near = 0.01;
void main() {
    seen = view_from_world * (position - eye);
    seen_normal = view_from_world * normal;
    seen_surface = surface;
    vec2 image = (seen.xy - window.xy * seen.z) * window.zw;
    gl_Position = vec4(-image.y, image.x, near, seen.z);
}
)";

/// 1/z is linear on the screen for any plane, also in the helper lanes beside a triangle, so the footprint
/// from its derivative stays on the triangle's plane: R = z L with L = |(x, y, 1)|, hence dR = z x/L dx - R z
/// d(1/z).
inline constexpr const char* fan_fragment_shader = R"(#version 450 core
in vec3 seen;
in vec3 seen_normal;
flat in float seen_surface;
uniform vec2 pixel;            // width along bearing, height along elevation on the image plane
layout(location = 0) out vec4 sample_out;
void main() {
    float range = length(seen);
    vec3 normal = normalize(gl_FrontFacing ? seen_normal : -seen_normal);
    float cosine = clamp(-dot(normal, seen) / range, 0.0, 1.0);
    float z = seen.z;
    float along_bearing = seen.x * z / range * pixel.x - range * z * dFdy(gl_FragCoord.w);
    float along_elevation = -seen.y * z / range * pixel.y - range * z * dFdx(gl_FragCoord.w);
    float footprint = abs(along_elevation) >= abs(along_bearing) ? abs(along_elevation) : -abs(along_bearing);
    sample_out = vec4(range, cosine, clamp(footprint, -0.5 * range, 0.5 * range), seen_surface);
}
)";

}  // namespace echoloop::gl
