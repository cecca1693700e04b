#pragma once

#include <filesystem>

#include "harness/export/exported_case.h"

namespace trammel::harness {

/// Writes the linear matrices of a scene (of large ones at no load) into a folder: K.mtx and M.mtx
/// of the free coordinates q, C.mtx where the analysis has Rayleigh damping, T.mtx with u = T q,
/// f.mtx (loads on q), coordinates.csv (what each of u is) and mesh.vtu. Matrix Market, symmetric
/// ones as their lower triangles; SI.
/// @throws InputError  where the folder cannot be written, or springs along a line or follower
///                     loads have no matrices.
void write_matrices(const Document& document, const ExportedScene& scene,
                    const std::filesystem::path& folder);

}  // namespace trammel::harness
