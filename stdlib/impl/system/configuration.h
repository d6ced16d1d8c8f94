#pragma once
// The configuration as programs read and change it (manual 1.17): a copy of what was loaded, completed by what the
// controller knows of its robot and its tasks. Changes do not reach the running controller.

#include "runtime/host/cfg_types.h"
#include "runtime/host/controller.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt::lib {

/// The value of an attribute, as far as its text shows.
enum class CfgKind { Number, Bool, Text };
CfgKind kindOf(const CfgAttribute& attribute);
bool isTrue(const CfgAttribute& attribute);

class Configuration {
  public:
    /// The service of this controller.
    static Configuration& of(Controller& controller);

    /// "/DOMAIN/TYPE/name" or "/DOMAIN/TYPE/attribute/value".
    struct Path {
        std::string domain, type, attribute, value;
        /// False when the text is not such a path.
        bool read(std::string_view text);
    };
    /// All instances that the path names, in order.
    std::vector<CfgInstance*> find(const Path& path);
    /// The attribute of an instance: that of the files, else what the controller knows without them. Null when there is neither.
    const CfgAttribute* attribute(const Path& path, const CfgInstance& instance, std::string_view name);
    /// The instance for changes. One that the controller has without a file becomes part of what text() gives.
    CfgInstance& kept(CfgInstance& instance);
    /// The attribute in any instance of the type: null when none has it.
    const CfgAttribute* anyOf(const Path& path, std::string_view attribute) const;

    /// The domain in the format of configuration files; empty when nothing of it is loaded.
    std::string text(std::string_view domain) const;

    bool isChanged() const { return changed_; }

  private:
    void load(Controller& controller);
    void addRobots(Controller& controller);
    void addImplied(const Controller& controller);
    CfgInstance& motionInstance(const std::string& type, const std::string& name);
    void addAxis(const robot::RobotModel& model, std::size_t axis, const std::string& name);

    std::vector<CfgFile> files_;
    /// One more file a domain, not written: instances that a controller has without a file.
    std::vector<CfgFile> implied_;
    bool loaded_ = false, changed_ = false;
};

} // namespace rt::lib
