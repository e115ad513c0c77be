#include "observers/field_observer.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "io/checkpoint.hpp"
#include "io/earlier_fields.hpp"
#include "io/first_process.hpp"
#include "observers/field_output.hpp"

namespace fsi {

namespace {

constexpr const char* entries_name = "field_entries";  // written up to the last level observed

template <int n>
class FieldObserver : public Observer {
 public:
  explicit FieldObserver(const RunView<n>& watched) : watched_(watched) {}

  void begin(const State& state) override {
    const auto& [folder, from] = std::pair(watched_.folder, watched_.restarted_from);
    const bool restarted = !from.empty();
    if (writes_fields(watched_.setup))
      for (const auto& name : unmet_fields<n>(
               watched_.setup, wanted_fields(watched_.setup, watched_.scene, watched_.derived, watched_.grids)))
        watched_.messages.warn(
            fmt::format("output.fields: \"{}\" is no field of this scene: nothing is written of it", name));
    fields_.emplace(watched_.setup, watched_.scene, watched_.derived, watched_.grids, watched_.grid_shares,
                    watched_.loads.axis(), folder, from, restarted ? shown_until(watched_.scene, state) : 0);
    if (!restarted) return;
    watched_.scene.processes().wait();  // until all have written
    if (writes_fields(watched_.setup))
      entries_ = found_entries(folder);
    else if (!std::filesystem::exists(folder / "fields.h5"))
      entries_ = 0;
  }
  void look(const State& level) override {
    // A restart does not find entries of later levels.
    if (fields_->write(level) && level.time <= shown_until(watched_.scene, watched_.state)) ++entries_;
  }
  /// \throws InputError where the earlier run's entries up to the last level observed are not all there, or where a
  /// restart in place would lose some of their fields
  void keep(RestartArchive& archive) override {
    if (archive.recalls() ? archive.has(entries_name) : entries_ > 0)
      archive.integer(entries_name, entries_, {0, 1e15, true});
    if (!archive.recalls() || !writes_fields(watched_.setup)) return;
    const auto& folder = watched_.restarted_from;
    const std::int64_t found = found_entries(folder);
    if (found < entries_)
      throw InputError(
          (folder / "fields.h5").string(), "",
          fmt::format("{} of {} entries up to {:g} ms are missing, which {} knows of", entries_ - found, entries_,
                      shown_until(watched_.scene, watched_.state), checkpoint_file(folder).string()),
          "bring the file back, or continue without fields by --set output.every=0");
    std::error_code error;
    if (std::filesystem::equivalent(watched_.folder, folder, error)) require_no_lost_fields();
  }

 private:
  void require_no_lost_fields() const {
    std::vector<std::string> names;
    const auto wanted = wanted_fields(watched_.setup, watched_.scene, watched_.derived, watched_.grids);
    for (std::size_t g = 0; g < wanted.size(); ++g)
      for (const auto& field : wanted[g]) names.push_back(watched_.grids[g].name + "." + field.name);
    if (names.empty()) return;
    do_together(watched_.scene.processes(), [&] {
      fsi::require_no_lost_fields(watched_.restarted_from, names, shown_until(watched_.scene, watched_.state));
    });
  }
  /// Entries of fields in a folder up to the last level observed.
  std::int64_t found_entries(const std::filesystem::path& folder) const {
    std::int64_t found = 0;
    do_together(watched_.scene.processes(), [&] {
      found = checked_field_entries(folder, watched_.grids, shown_until(watched_.scene, watched_.state));
    });
    return found;
  }

  RunView<n> watched_;
  std::optional<FieldOutput<n>> fields_;
  std::int64_t entries_ = 0;  ///< of the levels shown so far
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_field_observer(const RunView<n>& watched) {
  return std::make_unique<FieldObserver<n>>(watched);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_field_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
