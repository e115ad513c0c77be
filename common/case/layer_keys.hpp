#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// `structure.layers`: a section for each layer of the wall.
CaseKey<StructureData> layers_key();

/// Reads a layer's material with its constants. \param others  keys of the section that are not the layer's
void read_layer(const CaseEntry& entry, MaterialData& layer, const std::vector<std::string>& others = {});

/// Checks [structure] as a whole: bulk_modulus is that of layers whose material has none of its own.
/// \throws InputError where it is missing, or no layer uses it
void check_structure(const CaseEntry& entry, const StructureData& structure);

}  // namespace fsi
