#pragma once
// What is predefined and what of it is implemented, as linked into this executable; generated from the
// declarations.

#include <cstdint>
#include <span>
#include <string_view>

namespace rt {

enum class NativeKind : uint8_t { Instruction, Function };
/// Native: the C++ function `symbol`. Compiler: the compiler makes the code itself. Rapid: has a body in its
/// declaration.
enum class NativeForm : uint8_t { Native, Compiler, Rapid };

struct NativeEntry {
    const char* name;   ///< as declared
    const char* symbol; ///< "rt_" + name
    void* address;      ///< null: declared only
    NativeKind kind;
    NativeForm form;
    const char* chapter; ///< of the manual
    const char* option;  ///< RobotWare option it needs, or ""

    bool isImplemented() const { return address != nullptr || form != NativeForm::Native; }
};

/// Every predefined instruction and function, in the order of the declarations. Complete addresses need the
/// library rapidc_stdlib_whole.
std::span<const NativeEntry> nativeTable();

/// Entry points that compiled code calls without a name in RAPID (rt_strConcat ...).
struct SupportEntry {
    const char* symbol;
    void* address;
};
std::span<const SupportEntry> supportTable();

/// Address of a native or support entry point by its symbol; null if it is not implemented.
void* findNativeAddress(std::string_view symbol);

struct ErrorEntry {
    int32_t number;
    const char* name;    ///< "ERR_DIVZERO"
    const char* summary; ///< one sentence, may be empty
};
/// All error constants, ascending by number.
std::span<const ErrorEntry> errorTable();
/// Name of an error number; null for numbers that the program made itself.
const char* errorName(int32_t number);

} // namespace rt
