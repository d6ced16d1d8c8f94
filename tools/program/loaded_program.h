#pragma once
// LoadedProgram: a checked program with its code in memory, ready for a controller, and able to compile modules that come later. For
// `rapidc run`, the debug adapter and the long-lived controller.

#include "codegen/codegen.h"
#include "ir/core/ir.h"
#include "tools/program/pipeline.h"

#include <memory>
#include <string>

namespace rt {
class Controller;
class UnitLoader;
struct ProgramDesc;
} // namespace rt

namespace rapidc {

class SourceCompiler;
struct ProgramSources;

struct CompileSettings {
    std::string name;      ///< of the program, for its symbols and messages
    bool stepping = false; ///< the stepping profile
    bool optimise = true;
    bool inParts = false;      ///< each routine when it is called first, even in a small program
    bool startsAtOnce = false; ///< the same, unless the program is small
    bool interpreted = false;  ///< every routine is interpreted, not only huge ones
    bool executedOnce = false; ///< main runs once: its own loops need no better code than that
    bool keepsProgram = true;  ///< false: compilation().program is dropped and becomes null
};

class LoadedProgram {
  public:
    /// `compilation` has been checked; it may hold errors.
    explicit LoadedProgram(std::unique_ptr<Compilation> compilation);
    ~LoadedProgram();
    LoadedProgram(const LoadedProgram&) = delete;
    LoadedProgram& operator=(const LoadedProgram&) = delete;

    /// Lowers and generates code. False: the diagnostics of the compilation say why, or `error` does when it is not empty.
    bool compile(const CompileSettings& settings, std::string& error);

    const Compilation& compilation() const { return *compilation_; }
    /// After compile().
    const rt::ProgramDesc& description() const;
    const ProgramSources& sources() const { return *sources_; }
    /// Gives a controller, before it is prepared, the standard library, the loader of modules and the writer of module files. The
    /// program must outlive the controller.
    void equip(rt::Controller& controller) const;

  private:
    std::unique_ptr<Compilation> compilation_;
    ir::Module module_;
    codegen::CodegenOptions options_;
    std::unique_ptr<codegen::JitProgram> code_;
    std::unique_ptr<ProgramSources> sources_;
    std::unique_ptr<SourceCompiler> compiler_;
    std::unique_ptr<rt::UnitLoader> loader_;
};

} // namespace rapidc
