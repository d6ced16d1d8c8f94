#pragma once
// FileService: /fileservice, files and folders of the controller's volumes.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/file_volumes.h"

namespace rapidc::rws {

class FileService {
  public:
    /// The volumes must outlive the routes; handlers run on workers.
    explicit FileService(const service::FileVolumes& volumes) : volumes_(volumes) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply volumes(const Request& request) const;
    Reply get(const Request& request) const;
    Reply put(const Request& request) const;
    Reply remove(const Request& request) const;
    /// RWS 1.0: fs-action=create, copy or rename in the form.
    Reply act(const Request& request) const;
    Reply create(const Request& request) const;
    Reply copy(const Request& request) const;
    Reply rename(const Request& request) const;

    const service::FileVolumes& volumes_;
};

/// The reply to a request whose work on files failed.
Reply refuseFile(const service::FileResult& result);
/// "$HOME/a" of "/fileservice/$HOME/a" or "/fileservice/HOME/a" or "$HOME/a".
std::string pathInVolume(std::string_view text);

} // namespace rapidc::rws
