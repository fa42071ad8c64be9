#pragma once
#include "engine/brdf/brdf_models.h"
#include "engine/scene/scene.h"

namespace nacre::test {

// A table filled from a model at the texels' own directions.
Material materialOf(const BrdfModel& model, TableDomain domain, glm::ivec3 size);

// A narrow coloured highlight over a coloured diffuse part.
Material glossyMaterial(TableDomain domain = {kHalfDifference, kHalfPi / 2});

// The same, brighter where the normal leans towards the light than where it leans to the camera.
Material oneWayMaterial();

// Normals of every kind in one picture: a sphere whose rim reaches beyond the horizon, waves on it, a hole.
NormalMap bumpyNormals(int width, int height);

// `count` lights spread over the cap within `maxDegrees` of the view, of uneven colours.
std::vector<Light> capOfLights(int count, float maxDegrees);

// bumpyNormals of glossyMaterial under three lights.
Scene glossyScene(int width, int height);

} // namespace nacre::test
