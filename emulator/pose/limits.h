#pragma once

namespace echoloop {

inline constexpr double farthest = 1e6;  ///< m from the origin: what is beyond is no position
/// m/s and rad/s: what is beyond is no velocity.
inline constexpr double swiftest = 100;
inline constexpr double longest = 4e9;  ///< s: what is beyond is no time

}  // namespace echoloop
