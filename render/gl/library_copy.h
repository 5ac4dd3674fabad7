// A second instance of a shared library that is loaded already, with variables of its own. Never unloads one.
#pragma once

namespace echoloop::gl {

/// Loads the file that `handle` (of dlopen) came from once more. nullptr where the system has reasons against
/// it, such as no /proc or no programs in memory (vm.memfd_noexec). What the library depends on is shared by
/// all instances.
void* load_copy(void* handle);

}  // namespace echoloop::gl
