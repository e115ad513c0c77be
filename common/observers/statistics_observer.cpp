#include "observers/statistics_observer.hpp"

#include "fem/dimensions.hpp"

namespace fsi {

namespace {

template <int n>
class StatisticsObserver : public Observer {
 public:
  StatisticsObserver(DerivedQuantities<n>& derived, Profile& profile) : derived_(derived), profile_(profile) {}

  void look(const State& level) override {
    const auto measured = profile_.phase("wall shear stress");
    derived_.statistics->add(level.time, derived_.shear->at_nodes(level.now));
  }
  void keep(RestartArchive& archive) override { derived_.statistics->keep(archive); }

 private:
  DerivedQuantities<n>& derived_;
  Profile& profile_;
};

}  // namespace

template <int n>
std::unique_ptr<Observer> make_statistics_observer(const RunView<n>& watched) {
  if (!watched.derived.statistics) return nullptr;
  return std::make_unique<StatisticsObserver<n>>(watched.derived, watched.scene.profile);
}

#define FSI_INSTANTIATE(n) template std::unique_ptr<Observer> make_statistics_observer(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
