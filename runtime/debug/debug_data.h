#pragma once
// Data of a stopped program by name: finding, showing and changing them. Values are RAPID text as in a declaration.

#include "runtime/abi/rt_abi.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace rt {

/// One data object or a part of one. Array dimensions known at run time only are resolved here.
struct DebugVariable {
    std::string name;
    const TypeDesc* type = nullptr; ///< of the object; when rank > 0: of the elements
    void* data = nullptr;           ///< null: not given (optional parameter), or not found
    uint8_t rank = 0;               ///< array that is not described by `type`
    int32_t dims[3] = {0, 0, 0};
    bool isParameter = false;
    bool isConstant = false;
    bool isPersistent = false;
    std::string module; ///< module data
};

/// Module data as a variable.
DebugVariable dataOf(const GlobalDesc& desc);
/// "num", "num{3,4}"
std::string typeName(const DebugVariable& variable);
/// Value as RAPID text; arrays longer than `maxElements` are cut off with "...". Handles: "<signaldo>".
std::string valueText(const DebugVariable& variable, uint32_t maxElements = 64);
/// The part `path` ("{2}.trans.x", "" = the whole) of an object. Null data and a message in `error` when there is none.
DebugVariable partOf(const DebugVariable& variable, std::string_view path, std::string& error);
/// "" or why a person or client may not give data this value: a byte among it is not a whole number from 0 to 255. A program may
/// compute such values, so reading a text takes them.
std::string rangeProblem(const void* data, const TypeDesc& type);
/// Writes a value given as RAPID text into data of a type, which people know as `shownType`. "" or what is wrong; then nothing has changed.
std::string writeText(std::string_view text, void* data, const TypeDesc& type, const std::string& shownType);
/// The same for a variable that may be changed; arrays only element by element.
std::string assignText(const DebugVariable& variable, std::string_view text);

} // namespace rt
