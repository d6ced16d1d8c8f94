#include "tools/program/loaded_program.h"

#include "runtime/host/controller.h"
#include "runtime/host/module_saver.h"
#include "runtime/host/module_units.h"
#include "runtime/host/unit_loader.h"
#include "stdlib/native_table.h"
#include "stdlib/standard_library.h"
#include "tools/program/drop_program.h"
#include "tools/program/module_store.h"
#include "tools/program/native_library.h"
#include "tools/program/program_sources.h"
#include "tools/program/unit_compiler.h"

namespace rapidc {

LoadedProgram::LoadedProgram(std::unique_ptr<Compilation> compilation)
    : compilation_(std::move(compilation)) {}

LoadedProgram::~LoadedProgram() = default;

bool LoadedProgram::compile(const CompileSettings& settings, std::string& error) {
    options_ = codegenOptions(settings.optimise);
    if (settings.startsAtOnce) options_.partsAbove = codegen::kSmallProgram;
    if (settings.inParts) options_.partsAbove = 0;
    options_.interpretsAll = settings.interpreted;
    options_.isExecutedOnce = settings.executedOnce;
    if (compilation_->sink.hasErrors() ||
        !lowerToIr(*compilation_, settings.name, settings.stepping, module_, options_.partsAbove + 1))
        return false;
    sources_ = sourcesOf(*compilation_, settings.stepping, settings.optimise);
    if (!settings.keepsProgram) dropProgram(*compilation_); // generating code needs as much memory again
    runPassesInParts(options_, module_, irPasses(*compilation_, settings.stepping));
    code_ = codegen::jit(module_, options_, nativeSymbols(), error);
    if (!code_) return false;
    compiler_ = std::make_unique<SourceCompiler>(*sources_);
    loader_ = std::make_unique<rt::UnitLoader>(*compiler_, rt::findNativeAddress);
    return true;
}

const rt::ProgramDesc& LoadedProgram::description() const {
    return *code_->program();
}

void LoadedProgram::equip(rt::Controller& controller) const {
    rt::setUpStandardLibrary(controller);
    rt::setModuleLoader(controller, loader_.get());
    controller.saver().setStore(std::make_unique<SourceStore>());
}

} // namespace rapidc
