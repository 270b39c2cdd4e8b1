"""What hulls are made of: a table of materials with the source of each number."""

import difflib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from stommel.errors import FileError, Problem, StommelError
from stommel.files.fields import Table
from stommel.files.opening import TOML_MIB, read_text
from stommel.files.provenance import separate
from stommel.files.ranges import Stress, ThermalExpansion, between
from stommel.files.sentences import MOST_PROBLEMS, dotted, validated
from stommel.files.toml_reader import parse_toml
from stommel.vehicle import Provenance

TABLE = "materials.toml"
Grade = Annotated[int, Field(strict=True, ge=0, le=4)]


class MaterialError(StommelError):
    """A material that no table has."""


class Properties(Table):
    """One material, as its table describes it."""

    title: str
    aliases: tuple[str, ...] = ()
    elastic_modulus_mpa: Annotated[float, between(10, 1.5e6)]
    poisson_ratio: Annotated[float, between(0.01, 0.49)]
    density_kg_m3: Annotated[float, between(100, 23000)]
    yield_stress_mpa: Stress | None = None
    tensile_stress_mpa: Stress | None = None
    failure_stress_mpa: Stress | None = None
    permissible_stress_mpa: Stress | None = None
    thermal_expansion_per_k: ThermalExpansion
    corrosion_grade: Grade
    corrosion: str
    machinability_grade: Grade
    machinability: str
    remark: str = ""

    @model_validator(mode="after")
    def _has_a_strength(self) -> Self:
        if (self.yield_stress_mpa is None or self.tensile_stress_mpa is None) and (
            self.failure_stress_mpa is None or self.permissible_stress_mpa is None
        ):
            raise ValueError(
                "needs yield_stress_mpa and tensile_stress_mpa, or failure_stress_mpa and permissible_stress_mpa"
            )
        return self


@dataclass(frozen=True)
class Material:
    """A material by name, in SI units."""

    name: str
    properties: Properties
    provenance: Mapping[str, Provenance] = field(repr=False)
    """Origin of each number, by its key."""

    @property
    def E(self) -> float:
        """Elastic modulus [Pa]."""
        return self.properties.elastic_modulus_mpa * 1e6

    @property
    def nu(self) -> float:
        """Poisson ratio [1]."""
        return self.properties.poisson_ratio

    @property
    def rho(self) -> float:
        """Density [kg/m3]."""
        return self.properties.density_kg_m3

    @property
    def sigma_fail(self) -> float:
        """Stress at which the wall fails [Pa]: yield, or what the material's table gives instead."""
        stress = self.properties.failure_stress_mpa or self.properties.yield_stress_mpa
        assert stress is not None  # the validator of Properties sees to it
        return stress * 1e6

    def permissible_stress(self, yield_factor: float, tensile_factor: float) -> tuple[float, str]:
        """Permissible stress [Pa] and the rule that gives it: min(yield / n_y, tensile / n_t), Table 4 of the paper."""
        p = self.properties
        if p.permissible_stress_mpa is not None:
            return p.permissible_stress_mpa * 1e6, "stated for the material"
        assert p.yield_stress_mpa is not None
        assert p.tensile_stress_mpa is not None
        by_yield, by_tensile = p.yield_stress_mpa / yield_factor, p.tensile_stress_mpa / tensile_factor
        if by_yield <= by_tensile:
            return by_yield * 1e6, f"yield / {yield_factor:g}"
        return by_tensile * 1e6, f"tensile / {tensile_factor:g}"


def load_materials(path: Path | None = None) -> tuple[Material, ...]:
    """The materials that come with stommel; with `path`, those of that file too, which replace others of their name.

    Raises
    ------
    FileError
        The file cannot be read, or says something impossible; every problem is listed.
    """
    text = (resources.files(__package__) / TABLE).read_text(encoding="utf-8")
    found = {material.name: material for material in materials_from_text(text, TABLE)}
    if path is not None:
        text = read_text(path, TOML_MIB)
        found |= {material.name: material for material in materials_from_text(text, str(path))}
    return tuple(found.values())


def materials_from_text(text: str, origin: str) -> tuple[Material, ...]:
    """Read a table of materials; `origin` names it in messages.

    Raises
    ------
    FileError
        As `load_materials`.
    """
    document, provenance = separate(parse_toml(text, origin), origin)
    problems: list[Problem] = []
    materials = []
    for name, table in document.items():
        try:
            properties = validated(table, Properties, origin)
        except FileError as error:
            words = dotted([name])
            problems += [Problem(origin, f"{words}.{one.key}", f"[{words}] {one.message}") for one in error.problems]
            if len(problems) >= MOST_PROBLEMS:
                break
        else:
            materials.append(Material(name, properties, _below(name, provenance)))
    if problems:
        raise FileError(problems)
    return tuple(materials)


def _below(name: str, provenance: Mapping[str, Provenance]) -> dict[str, Provenance]:
    prefix = f"{name}."
    return {key.removeprefix(prefix): origin for key, origin in provenance.items() if key.startswith(prefix)}


def find_material(name: str, materials: tuple[Material, ...]) -> Material:
    """The material of this name or alias; case, blanks and hyphens do not count.

    Raises
    ------
    MaterialError
        There is none; the error lists those there are.
    """
    wanted = _plain(name)
    for material in materials:
        if wanted in {
            _plain(known) for known in (material.name, material.properties.title, *material.properties.aliases)
        }:
            return material
    names = [material.name for material in materials]
    near: list[Any] = difflib.get_close_matches(name, names, 1, 0.6)
    hint = f"; did you mean {near[0]}?" if near else ";"
    raise MaterialError(f"material {name!r}: unknown{hint} known materials: {', '.join(names)}")


def _plain(name: str) -> str:
    return name.casefold().replace(" ", "").replace("-", "").replace("_", "")
