#pragma once
// The reports of a check: to the sink, to a list of their own while a call is judged, or dropped.

#include "frontend/sema/contexts.h"

namespace rapid::sema {

/// How a node of the tree does not fit the declaration of what it uses.
enum class Misfit : uint8_t {
    Type,      ///< the value of an expression has a different type than its place needs
    Operator,  ///< an operator does not take the types of its operands
    NotArray,  ///< an index
    NotRecord, ///< a component
    Aggregate, ///< a list of values for data of one value
    Access,    ///< data are changed that are not declared so
    Kind,      ///< its place does not take data of this kind: no value, an entire array, several types
};

/// A misfit that was reported. Another mistake, such as the type of a declaration, may be its cause.
struct Subject {
    Misfit misfit;
    const syntax::Node& node;
};
struct ReportedMisfit {
    Misfit misfit;
    const syntax::Node* node;
    diag::CauseId cause; ///< of the report
};

class Reports {
  public:
    Reports(diag::Sink& sink, const Context& context) : sink_(sink), context_(context) {}

    /// In the file of the context, with a cause of its own. Reports about a line that could not be read are dropped.
    diag::Diagnostic& report(Code code, SourceRange where, std::span<const std::string> args);
    /// Remembers that `diagnostic`, the last report, is about `subject`.
    void noteMisfit(const diag::Diagnostic& diagnostic, const Subject& subject);
    /// Of the file that is being checked, in the order of reporting; some of the reports may have been taken back.
    const std::vector<ReportedMisfit>& misfits() const { return misfits_; }
    void forgetMisfits() { misfits_.clear(); }
    bool isUnclear(SourceRange where) const;
    bool hasUnclearLine(const syntax::Node& node) const;
    /// Whether `diagnostic`, which report() gave, is left out.
    bool isUnsaid(const diag::Diagnostic& diagnostic) const { return &diagnostic == &unsaid_; }

    /// Drops reports, in text that could not be read as a whole, which is reported. Returns the value before.
    bool mute(bool muted) { return std::exchange(muted_, muted); }
    /// Reports about the arguments of the call being checked go to `sink`; null: not in a call. Returns the value before.
    diag::Sink* collectIn(diag::Sink* sink) { return std::exchange(collect_, sink); }
    diag::Sink* collected() const { return collect_; }
    /// The rest of a line of the routine that was meant in a different way, which is reported.
    void setQuietLine(SourceRange line) {
        quietLine_ = line;
        quietTree_ = context_.tree;
    }
    /// Empty in another file.
    SourceRange quietLine() const { return quietTree_ == context_.tree ? quietLine_ : SourceRange{}; }

  private:
    diag::CauseId unfinishedLine(Code code, SourceRange where) const;
    bool isOfUnfinished(Code code, SourceRange where, uint32_t end) const;

    diag::Sink& sink_;
    const Context& context_;
    diag::Sink* collect_ = nullptr;
    SourceRange quietLine_;
    const syntax::SyntaxTree* quietTree_ = nullptr; ///< that it is in
    bool muted_ = false;
    uint32_t lastCause_ = 0;
    std::vector<ReportedMisfit> misfits_;
    diag::Diagnostic unsaid_;
};

} // namespace rapid::sema
