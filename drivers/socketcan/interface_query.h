#pragma once
// Questions to the kernel about a network interface, by name, through any socket. They never wait
// and never allocate.

#include <optional>
#include <string_view>

namespace dottrack::drivers {

// Nothing if there is no interface of that name; all interface names are shorter than 16 bytes.
std::optional<int> interface_index(int descriptor, std::string_view name);
std::optional<int> interface_mtu_bytes(int descriptor, std::string_view name);
std::optional<unsigned> interface_flags(int descriptor, std::string_view name);     // IFF_...
std::optional<unsigned> interface_hardware(int descriptor, std::string_view name);  // ARPHRD_...

}  // namespace dottrack::drivers
