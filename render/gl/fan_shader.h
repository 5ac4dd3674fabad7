// The shaders that draw one view of a fan. Each pixel gets range, cos(incidence), range footprint of
// a pixel of the usual size, and surface.
#pragma once

namespace echoloop::gl {

/// Attributes: 0 position (world), 1 normal (world), 2 surface number. The image is transposed: clip x runs
/// along falling elevation, clip y along bearing. Depth is near / distance along the view's axis, so 1 is
/// nearest. The surface number travels with the normal, as the fewer vectors the quicker; it is the same at
/// all corners, and a quarter on top keeps rounding from changing it. Its fraction is half the roughness.
inline constexpr const char* fan_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float surface;
uniform mat3 view_from_world;  // rows: starboard, up, forward
uniform vec3 eye;
uniform vec4 window;           // centre x, centre y, 2 / width, 2 / height on the image plane
out vec3 seen;                 // m: starboard, up, forward
out vec4 seen_normal;          // and the surface
const float near = 0.01;
void main() {
    seen = view_from_world * (position - eye);
    seen_normal = vec4(view_from_world * normal, surface + 0.25);
    vec2 image = (seen.xy - window.xy * seen.z) * window.zw;
    gl_Position = vec4(-image.y, image.x, near, seen.z);
}
)";

/// The same where rays bend. A point is drawn where its ray leaves the sonar, as far off as it is in time, so
/// that what is left to draw is straight; and its normal is turned with it, so that it meets the ray as it
/// does in truth. Both turn in the upright plane of the line, so they take a share of the line and one of
/// what is upwards. Angles are small: sines and cosines are their series, to 2e-4 at 1 rad.
inline constexpr const char* bent_vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float surface;
uniform mat3 view_from_world;
uniform vec3 eye;
uniform vec4 window;
uniform vec3 up;               // in the view
uniform vec4 columns;          // RayTable: places in the texture per m, and of the first; of its rows likewise
uniform vec3 rows;             // rows: sqrt(x + |height| y) - z from the sonar's depth
uniform sampler2D rays;        // RayTable::moves()
out vec3 seen;
out vec4 seen_normal;
const float near = 0.01;
void main() {
    vec3 line = view_from_world * (position - eye);
    float height = dot(line, up);
    vec3 level = line - height * up;
    float x = length(level);
    float u = sqrt(rows.x + abs(height) * rows.y) - rows.z;
    vec4 move = textureLod(rays, vec2(x, height > 0.0 ? -u : u) * columns.xz + columns.yw, 0.0);
    seen = line + move.x * level + move.y * up;
    // The bow, as a vector along the level; its sine over it; and 1 less its cosine over its square.
    vec3 bow = move.z * (1.0 + move.x) * level;
    float q = dot(bow, bow), sine = 1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0)),
          versine = 0.5 - q * (1.0 / 24.0 - q * (1.0 / 720.0));
    vec3 n = view_from_world * normal;
    float n_along = dot(n, bow), n_up = dot(n, up);
    n += (n_up * sine - n_along * versine) * bow - (n_up * q * versine + n_along * sine) * up;
    seen_normal = vec4(n, surface + 0.25);
    vec2 image = (seen.xy - window.xy * seen.z) * window.zw;
    gl_Position = vec4(-image.y, image.x, near, seen.z);
    gl_ClipDistance[0] = move.w;
}
)";

/// The mean echo of a rough surface is that of its mean normal and more: facets that lean towards us scatter
/// more and show more of themselves, E[(n v)^2] / E[n v].
///
/// 1/z is linear on the screen for any plane, also in the helper lanes beside a triangle, so the footprint
/// from its derivative stays on the triangle's plane: R = z L with L = |(x, y, 1)|, hence dR = z x/L dx - R z
/// d(1/z).
inline constexpr const char* fan_fragment_shader = R"(#version 330 core
in vec3 seen;
in vec4 seen_normal;
uniform vec4 pixel;            // width along bearing, height along elevation on the image plane; of a usual one in pixels
layout(location = 0) out vec4 sample_out;
void main() {
    float square = dot(seen, seen), inverse = inversesqrt(square), range = square * inverse;
    float towards = -dot(seen_normal.xyz, seen) * inverse * inversesqrt(dot(seen_normal.xyz, seen_normal.xyz));
    float cosine = clamp(gl_FrontFacing ? towards : -towards, 0.0, 1.0);
    float lean = max(fract(seen_normal.w) - 0.25, 0.0);  // variance of the normal in the direction that we look along
    cosine = min(cosine + lean * (1.0 - cosine * cosine) / max(cosine, 0.1), 1.0);
    float shrink = seen.z * inverse, slope = range * seen.z;
    float along_bearing = pixel.z * abs(seen.x * shrink * pixel.x - slope * dFdy(gl_FragCoord.w));
    float along_elevation = pixel.w * abs(seen.y * shrink * pixel.y + slope * dFdx(gl_FragCoord.w));
    float footprint = min(max(along_bearing, along_elevation), 0.5 * range);
    footprint = along_elevation >= along_bearing ? footprint : -footprint;
    sample_out = vec4(range, cosine, footprint, floor(seen_normal.w));
}
)";

}  // namespace echoloop::gl
