#pragma once
// ExpressionCompiler: turns an expression or instructions, typed by a person who debugs a program, into code that can be called
// as if they stood in one of its routines. Knows nothing of a running program beyond its tables.

#include "runtime/host/controller.h"
#include "runtime/host/mapped_image.h"
#include "tools/program/pipeline.h"

#include "frontend/sema/session.h"

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace rapidc::dap {

/// The place from which a text is evaluated.
struct ExpressionScope {
    int32_t task = 0;
    std::string module;  ///< "": data of all modules that are not LOCAL
    std::string routine; ///< "": data of modules only
};

/// The effects that the text may have when it is executed.
enum class ExpressionKind : uint8_t {
    Value,    ///< an expression
    Harmless, ///< an expression that changes nothing: no routine of the program, no native that writes or waits
    Orders,   ///< instructions
};

/// Code for one text. Its parameters: the number of the error that ended it, its value (expressions), and the data of the
/// routine that it names.
struct CompiledExpression {
    std::unique_ptr<rt::MappedImage> image;
    const rt::RoutineEntry* entry = nullptr;
    bool hasValue = false;
    std::vector<std::string> names; ///< of the routine's data
};

class ExpressionCompiler {
  public:
    /// `compilation` and `controller` must outlive the compiler.
    ExpressionCompiler(const Compilation& compilation, rt::Controller& controller);
    ~ExpressionCompiler();

    /// Null, with what is wrong with the text in `problem`. The result lives as long as the compiler.
    const CompiledExpression* compile(const ExpressionScope& scope, const std::string& text,
                                      ExpressionKind kind, std::string& problem);

  private:
    struct Draft;
    /// When modules have come or gone, everything is compiled again.
    void followMemory();
    void openSession();
    bool check(Draft& draft, std::string& problem);
    bool judge(const Draft& draft, std::string& problem) const;
    bool generate(const Draft& draft, CompiledExpression& out, std::string& problem);
    bool map(const rt::UnitImage& image, const struct ImportedData& data, int32_t task,
             CompiledExpression& out, std::string& problem);
    std::unique_ptr<CompiledExpression> make(const ExpressionScope& scope, const std::string& text,
                                             ExpressionKind kind, std::string& problem);

    const Compilation& compilation_;
    rt::Controller& controller_;
    std::unique_ptr<rapid::sema::Session> session_;
    std::map<std::tuple<int32_t, std::string, std::string, std::string, ExpressionKind>,
             std::unique_ptr<CompiledExpression>>
        known_;
    std::string memory_; ///< what was in program memory when they were compiled
    std::vector<std::unique_ptr<CompiledExpression>> former_; ///< code that may be in progress
};

} // namespace rapidc::dap
