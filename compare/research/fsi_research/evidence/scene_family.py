"""Families of runs about scenes of the gallery, for the kinds of study that judge them."""

from dataclasses import dataclass
from typing import Optional, Sequence

from fsi_compare.base.errors import InputError
from fsi_compare.gallery.scene import Scene
from fsi_compare.study.context import Context
from fsi_compare.study.study_file import Study
from fsi_compare.verify.family import CaseFacts, Requests, read_case
from fsi_compare.verify.mesh_family import Recipe, recipe_of_scene


@dataclass(frozen=True)
class SceneFamily:
    """What decides the members of a scene's family, and what the runner is asked for each."""

    scene: Scene
    facts: CaseFacts
    recipe: Recipe
    requests: Requests


def require_scenes(study: Study) -> None:
    """Raises InputError where a case of the study is no scene."""
    for case in study.cases:
        if case not in study.scenes:
            remedy = 'name a scene of the gallery: { scene = "NAME" }'
            raise InputError(study.path, f"cases.{case}", "is no scene", remedy)


def scene_family(context: Context, case: str, drivers: Optional[Sequence[str]] = None) -> SceneFamily:
    """`drivers`: without "fsi-"; those that the scene knows where none are given. Raises InputError."""
    study, runner = context.study, context.runner
    scene, maker = study.scenes[case], runner.mesh_maker
    if maker is None:
        raise InputError("fsi-mesh", "", "is not beside the drivers", "build it with cmake --build --preset release")
    settings = {**study.settings, **study.case_settings.get(case, {})}
    facts = read_case(scene.case, settings)
    recipe = recipe_of_scene(scene, maker, study.quick)
    names = [program[len("fsi-") :] for program in scene.drivers] if drivers is None else drivers
    folder = runner.folder / "scripts" / case
    return SceneFamily(scene, facts, recipe, Requests(facts, recipe, folder, names, study.time_limit, settings, case))
