#pragma once
// The generated files, each as one text.

#include "ir/core/ir.h"
#include "stdlib/gen/model.h"

namespace stdlibgen {

/// How values of a type are represented, those of an alias as those of its type; Repr::Record for an unknown name.
Repr reprOf(const Model& model, std::string_view type);
/// num, dnum or bool.
bool isScalar(Repr repr);
/// Whether a native is called by value without a task (class Const) or with a task and a status (class
/// Plain). Const: `effects: const`, result and all parameters are required num, dnum or bool, mode IN.
bool isConstNative(const Model& model, const Routine& routine);
/// An argument that gets to a native in a register, not by its address.
bool isPassedByValue(const Model& model, const Param& param);
/// False for routines that the compiler replaces altogether (Present, Dim, WaitUntil).
bool hasPrototype(const Routine& routine);
/// "rt_" and the name as declared.
std::string symbolOf(const Routine& routine);
/// The C++ type of a value: float, rt::String, rt::data::Robtarget, rt::Handle ...
std::string cppType(const Model& model, std::string_view type);
/// A RAPID name as a C++ identifier: keywords and macros get a trailing '_'.
std::string cppName(std::string_view name);

/// The layout that compiled code uses for a predefined type: num, dnum, bool, string, handles and records of them. Adds the
/// records it contains to `module`.
ir::TypeId layoutOf(const Model& model, std::string_view type, ir::Module& module);

std::string emitTypes(const Model& model);
/// Assertions that C++ lays out every record of stdlib_types.h as compiled code does (layoutOf).
std::string emitLayoutChecks(const Model& model);
std::string emitConstants(const Model& model);
/// The prototypes of the natives that one file declares: a changed declaration compiles only what includes them again.
std::string emitNatives(const Model& model, const SourceText& source);
std::string emitNativeTable(const Model& model);
/// How the compiler calls functions without side effects (stdlib/constant_calls.h).
std::string emitConstantCalls(const Model& model);
std::string emitErrorTable(const Model& model);
std::string emitSources(const Model& model);
std::string emitJson(const Model& model);

/// A page of the reference in docs/reference.
struct Page {
    std::string file; ///< "math.md"
    std::string text;
};
/// A page a declaration file, one of all types, one of all data, and README.md, the index.
std::vector<Page> emitReference(const Model& model);

} // namespace stdlibgen
