#pragma once
// Which warnings are wanted: by the project file, by the command line, by comments in the source.
//
//     ! rapidc: ignore unused-variable          this line, or the next one when the comment is alone on its line
//     ! rapidc: off zone-too-small              from here to the end of the file or to `on`
//     ! rapidc: on zone-too-small
//
// Several names are separated by commas; `lint` means all of 8xxx, `all` every warning; what follows `--` is a remark.

#include "frontend/diag/diagnostic.h"
#include "frontend/project/settings.h"

#include <string_view>
#include <vector>

namespace rapid::lint {

enum class Level : uint8_t { Off, Warning, Error };

/// The level of every warning.
class WarningLevels {
  public:
    WarningLevels();
    Level of(diag::Code code) const;
    bool isOn(diag::Code code) const { return of(code) != Level::Off; }
    /// Whether some warning of 8xxx is on.
    bool anyLint() const;
    /// `name`: a warning in kebab-case, `lint` or `all`. False if there is none of that name.
    bool set(std::string_view name, Level level);

  private:
    std::vector<Level> levels_; ///< by place in the catalogue
};

/// "; did you mean 'unused-variable'?" or "".
std::string warningSuggestion(std::string_view name);

/// Takes over the section "warnings" of a project file; unknown names and levels are reported.
void applySettings(const project::Settings& settings, WarningLevels& levels, diag::Sink& sink);

/// One `-W` of the command line: `NAME`, `no-NAME`, `error=NAME`, `error` (all of them). False with a message when it
/// is none of these.
bool applyOption(std::string_view option, WarningLevels& levels, std::string& problem);

/// Reports the comments `! rapidc:` that cannot be understood.
void checkDirectives(const std::shared_ptr<const SourceFile>& file, diag::Sink& sink);

/// Removes what is switched off and raises what is to be an error, by `levels` and by comments in the source files.
void applyLevels(const WarningLevels& levels, diag::Sink& sink);

} // namespace rapid::lint
