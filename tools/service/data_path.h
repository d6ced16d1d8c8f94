#pragma once
// Data of the running program by a path of names, their values as RAPID source text. Used on the controller's thread.

#include "runtime/debug/debug_data.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::service {

class VirtualController;

/// "RAPID/T_ROB1/Module1/list{3}.pos.x": task and module may be left out, a routine may follow the module.
struct DataPath {
    std::string task, module, routine; ///< "" = not given
    std::string name;
    std::string part; ///< "{3}.pos.x"; "" = the whole

    /// Names divided by slashes, with or without "RAPID" in front. None: it is no such path.
    static std::optional<DataPath> read(std::string_view text);
    std::string url() const;
};

/// Whatever a path leads to: an object, an element, a row of an array, a component. `data` is null when there is nothing; then `problem` says
/// why.
struct FoundData {
    void* data = nullptr;
    const rt::TypeDesc* type = nullptr; ///< of the object, or of the elements of an array
    std::vector<int32_t> dims;          ///< of an array
    bool isConstant = false;
    bool isProtected = false; ///< belongs to the system and cannot be changed
    bool isPersistent = false;
    std::string problem;

    std::size_t bytes() const;
};

/// An index may select a component of a record, too, by its number from 1; fewer indices than dimensions select a row.
FoundData findData(VirtualController& controller, const DataPath& path);
/// The type of this name: num, dnum, bool, string, or one that data in memory, or components of them, have. Null: there is none.
const rt::TypeDesc* typeNamed(VirtualController& controller, std::string_view name);
/// As a declaration has it: 5, TRUE, "text", [[1,2,3],[1,0,0,0]]. None: the type has no values as text.
std::optional<std::string> valueOf(const FoundData& found);
/// Writes such a text. "" or what is wrong; then nothing has changed.
std::string assign(const FoundData& found, std::string_view text);
/// Whether a text is a value of that type, without any data. "" or what is wrong.
std::string checkValue(const rt::TypeDesc& type, const std::vector<int32_t>& dims, std::string_view text);

} // namespace rapidc::service
