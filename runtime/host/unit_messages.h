#pragma once
// What a built executable and the installed rapidc say to each other when a module is to be compiled: CBOR on the standard
// input and output of `rapidc compile-unit`.

#include "runtime/host/unit_compiler.h"
#include "runtime/program/program_tables.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {

/// Configured signals: name, and the type of its variables ("signaldo").
using SignalNames = std::vector<std::pair<std::string, std::string>>;

/// The request as its receiver has it: the tables hold names, no addresses.
struct UnitRequest {
    std::string sources; ///< what the executable was built from (ProgramDesc::sources)
    bool references =
        false; ///< only the open references of the task are asked for; the file to be loaded is empty
    LoadRequest load;
    SignalNames signals; ///< of the running controller
    ProgramTables tables;
    std::deque<LoadedFile> files;

  private:
    friend std::unique_ptr<UnitRequest> readUnitRequest(std::string_view);
    std::deque<std::string> names_; // what the tables point at
    std::vector<GlobalDesc> data_;
    std::vector<ModuleDesc> modules_;
    ProgramDesc program_{}, unit_{};
};

std::string writeUnitRequest(std::string_view sources, bool references, const LoadRequest& load,
                             const ProgramState& state, const SignalNames& signals);
/// Null when the bytes are none.
std::unique_ptr<UnitRequest> readUnitRequest(std::string_view bytes);

/// The answer; one of both is meant.
struct UnitAnswer {
    CompiledUnit unit;
    OpenReferences open;
};
std::string writeUnitAnswer(const UnitAnswer& answer);
std::optional<UnitAnswer> readUnitAnswer(std::string_view bytes);

} // namespace rt
