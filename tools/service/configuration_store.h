#pragma once
// ConfigurationStore: the system parameters as clients read and change them. Changes are written at once, the whole file of the domain by
// replacement, and take effect at the next restart. The user's own files stay as they are.

#include "config/cfg_parser.h"
#include "frontend/project/open_texts.h"
#include "tools/service/virtual_controller.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rapidc::service {

using CfgValues = std::vector<std::pair<std::string, std::string>>; ///< attribute, value as shown

class ConfigurationStore {
  public:
    /// The controller has been opened and outlives the store. `folder`: for the files of changed domains; it exists.
    ConfigurationStore(VirtualController& controller, std::string folder);
    ~ConfigurationStore();
    ConfigurationStore(const ConfigurationStore&) = delete;
    ConfigurationStore& operator=(const ConfigurationStore&) = delete;

    /// Takes the domains whose files an earlier process has left in the folder; they hold after VirtualController::reopen(). False when
    /// there are none.
    bool takeKept();

    static const std::vector<std::string>& domains(); ///< "EIO", "SYS" ...
    /// "EIO" for any spelling of it; "" when there is no such domain.
    static std::string domainNamed(std::string_view name);

    /// Those of the files and those that are known.
    std::vector<std::string> types(const std::string& domain) const;
    bool isType(const std::string& domain, std::string_view type) const;

    struct Instance {
        std::string name; ///< its name or, when the type has none, its number from 1
        CfgValues values; ///< all attributes; flags are true or false
    };
    std::vector<Instance> instances(const std::string& domain, std::string_view type) const;
    /// Without regard to case.
    std::optional<Instance> find(const std::string& domain, std::string_view type,
                                 std::string_view name) const;

    // Changes: "" or why not; then nothing has changed.
    Refusal set(const std::string& domain, std::string_view type, std::string_view name,
                const CfgValues& values);
    Refusal create(const std::string& domain, std::string_view type, const std::string& name,
                   const CfgValues& values);
    Refusal remove(const std::string& domain, std::string_view type, std::string_view name);

    enum class Load : uint8_t {
        Add, ///< what is there already is a refusal
        AddOrReplace,
        Replace, ///< everything of the domain goes first
    };
    /// `bytes`: of a configuration file. `tryOnly`: nothing is changed.
    Refusal load(std::string_view bytes, Load mode, bool tryOnly);

    /// The text of a domain as a file, "" when there is nothing of it.
    std::string text(const std::string& domain) const;
    /// All files for a backup: name and bytes. Domains that are as they were have the texts of their files.
    std::vector<std::pair<std::string, std::string>> files() const;
    /// Counts the changes.
    uint64_t changes() const { return changes_; }
    bool isChanged(const std::string& domain) const { return changed_.contains(domain); }

  private:
    rapid::config::CfgFile& fileOf(const std::string& domain);
    const rapid::config::CfgInstance* written(const std::string& domain, std::string_view type,
                                              std::string_view name) const;
    Instance shown(const std::string& domain, std::string_view type,
                   const rapid::config::CfgInstance* written, const rapid::config::CfgInstance* implied,
                   std::size_t number) const;
    Refusal put(rapid::config::CfgInstance& instance, const std::string& domain, std::string_view type,
                const std::string& attribute, const std::string& value) const;
    Refusal judge(const rapid::config::CfgFile& file, std::string_view type,
                  const rapid::config::CfgInstance* instance) const;
    Refusal replace(const std::string& domain, rapid::config::CfgFile file);
    void choose(Inputs& inputs);
    void addOptions(std::vector<rapid::config::CfgInstance>& instances) const;
    /// Everything as the present program has it.
    void read();

    VirtualController& controller_;
    std::string folder_;
    Observers::Token token_;
    std::vector<std::string> paths_;                      ///< of the inputs: after a restored backup others
    std::map<std::string, rapid::config::CfgFile> files_; ///< by domain
    std::set<std::string> changed_;                       ///< domains
    std::vector<std::pair<std::string, std::string>> originals_; ///< path and bytes of the files at the start
    std::vector<std::unique_ptr<rapid::project::OpenTexts>>
        texts_; ///< of each restart: compilations refer to them
    uint64_t changes_ = 0;
};

} // namespace rapidc::service
