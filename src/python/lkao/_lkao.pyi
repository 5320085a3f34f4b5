"""The extension module: private. The package around it checks what users pass, and says what it means."""

from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

_Array = npt.NDArray[Any]
_Floats = npt.NDArray[np.float32]
_Words = npt.NDArray[np.uint64]
_Triple = Tuple[float, float, float]
_Progress = Optional[Callable[[int, int], Any]]
_Map = Tuple[int, _Floats, Optional[_Floats], npt.NDArray[np.uint8]]
_Material = Tuple[Optional[float], float, int, str, str, bool]
_Rho = Optional[Callable[[float], float]]

version: str

def active_isa() -> str: ...
def choose_origin(positions: _Array) -> _Triple: ...
def load(name: str) -> Tuple[_Floats, npt.NDArray[np.uint32], _Triple]: ...
def open_file(
    name: str, uv_set: int, opaque: bool
) -> Tuple[
    _Floats,
    npt.NDArray[np.uint32],
    _Triple,
    Optional[_Floats],
    Optional[_Floats],
    Optional[npt.NDArray[np.uint32]],
    Optional[Holes],
    List[str],
    List[Tuple[str, str]],
    List[str],
]: ...
def view(
    positions: _Array,
    triangles: _Array,
    origin: _Triple,
    holes: Optional[Holes],
    eye: _Triple,
    target: _Triple,
    up: _Triple,
    fov: float,
    width: int,
    height: int,
    smooth: bool,
) -> Tuple[_Floats, _Floats, _Floats, _Floats]: ...
def simplify(
    positions: _Array,
    triangles: _Array,
    origin: _Triple,
    radius: float,
    epsilon: float,
    k: float,
    growth: float,
    level_count: int,
    thread_count: int,
    progress: _Progress,
) -> List[Tuple[_Floats, npt.NDArray[np.uint32], float, float, float]]: ...
def bake_texture(
    query: AmbientOcclusion,
    surface: Surface,
    occluders: Tuple[_Triple, _Triple],
    options: TextureOptions,
    detailed: Optional[Surface],
    extrusion: float,
    part: Optional[Tuple[int, int]],
    thread_count: int,
    progress: _Progress,
) -> Tuple[List[_Map], Dict[str, Any]]: ...
def finish_texture(
    surface: Surface, options: TextureOptions, maps: List[_Map]
) -> Tuple[List[_Map], Dict[str, Any]]: ...

class Cancelled(RuntimeError): ...

class SamplePattern:
    @staticmethod
    def make(
        kind: str,
        ray_count: int,
        falloff: str,
        rate: Optional[float],
        function: _Rho,
        seed: int,
        weighting: str,
    ) -> SamplePattern: ...
    @staticmethod
    def from_disk(points: _Floats, lengths: _Floats) -> SamplePattern: ...
    def with_falloff(self, falloff: str, rate: Optional[float], function: _Rho) -> SamplePattern: ...
    @property
    def ray_count(self) -> int: ...
    @property
    def word_count(self) -> int: ...
    @property
    def lowest_elevation(self) -> float: ...
    @property
    def disk(self) -> _Floats: ...
    @property
    def directions(self) -> _Floats: ...
    @property
    def lengths(self) -> _Floats: ...

class PlaneMaskTable:
    @staticmethod
    def make(
        pattern: SamplePattern, resolution: int, addressing: str, masks: str, thread_count: int
    ) -> PlaneMaskTable: ...
    def cell(self, normal: _Triple, distance: float) -> int: ...
    def masks_of(self, cell: int) -> _Words: ...
    @property
    def cell_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...
    @property
    def build_seconds(self) -> float: ...

class BuildReport:
    """What a build found and made."""

    @property
    def triangle_count(self) -> int: ...
    @property
    def occluder_count(self) -> int: ...
    @property
    def zero_area_count(self) -> int: ...
    @property
    def non_finite_count(self) -> int: ...
    @property
    def reference_count(self) -> int: ...
    @property
    def node_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def surface_area_cost(self) -> float: ...
    @property
    def growth(self) -> float: ...

class Holes:
    @staticmethod
    def make(
        images: List[npt.NDArray[np.uint16]],
        materials: List[_Material],
        triangle_materials: npt.NDArray[np.uint32],
        uvs: _Floats,
        alphas: _Floats,
        numbers: npt.NDArray[np.uint32],
    ) -> Holes: ...
    def parts(
        self,
    ) -> Tuple[
        List[npt.NDArray[np.uint16]],
        List[_Material],
        npt.NDArray[np.uint32],
        _Floats,
        _Floats,
        npt.NDArray[np.uint32],
    ]: ...
    def numbers(self) -> npt.NDArray[np.uint32]: ...

class OccluderScene:
    @staticmethod
    def make(
        positions: _Array,
        triangles: _Array,
        origin: _Triple,
        spatial_splits: bool,
        keep_zero_area: bool,
        refer: bool,
        opacities: Optional[_Floats],
        holes: Optional[Holes],
        thread_count: int,
        progress: _Progress,
    ) -> OccluderScene: ...
    @staticmethod
    def make_instances(
        meshes: List[OccluderScene],
        to_world: _Floats,
        mesh_numbers: npt.NDArray[np.uint32],
        groups: npt.NDArray[np.uint32],
        thread_count: int,
    ) -> OccluderScene: ...
    def instances(self) -> Tuple[_Floats, npt.NDArray[np.uint32], npt.NDArray[np.uint32]]: ...
    def refitted(
        self, positions: _Array, origin: _Triple, max_growth: float, thread_count: int, progress: _Progress
    ) -> OccluderScene: ...
    def move(self, numbers: npt.NDArray[np.uint32], to_world: _Floats) -> None: ...
    def set_groups(self, instance: int, groups: int) -> None: ...
    def set_mesh(self, number: int, mesh: OccluderScene) -> None: ...
    def report(self, mesh: int) -> BuildReport: ...
    @property
    def mesh_count(self) -> int: ...
    @property
    def instance_count(self) -> int: ...
    @property
    def occluder_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...
    @property
    def bounds(self) -> Tuple[_Triple, _Triple]: ...
    @property
    def origin(self) -> _Triple: ...

class Receivers:
    def __init__(
        self,
        positions: _Array,
        normals: _Array,
        geometric_normals: Optional[_Array],
        excluded: Optional[npt.NDArray[np.uint32]],
        instances: Optional[npt.NDArray[np.uint32]],
        groups: Optional[npt.NDArray[np.uint32]],
        origin: _Triple,
    ) -> None: ...

class QueryReport:
    """What a batch cast."""

    @property
    def receiver_count(self) -> int: ...
    @property
    def invalid_receiver_count(self) -> int: ...
    @property
    def ray_count(self) -> int: ...
    @property
    def blocked_ray_count(self) -> int: ...

class RayOptions:
    def __init__(
        self,
        radius: float,
        sided: str,
        rotation: float,
        tilt: float,
        seed: int,
        surface_offset: float,
        min_distance: float,
    ) -> None: ...

class AmbientOcclusion:
    @staticmethod
    def make(
        levels: List[Tuple[OccluderScene, float, float]], pattern: SamplePattern, options: RayOptions, kernel: str
    ) -> AmbientOcclusion: ...
    @staticmethod
    def make_with_table(
        scene: OccluderScene, table: PlaneMaskTable, options: RayOptions, node_masks: str
    ) -> AmbientOcclusion: ...
    def query(
        self,
        receivers: Receivers,
        occlusion: Optional[_Floats],
        bent_normals: Optional[_Floats],
        masks: Optional[_Words],
        first_index: int,
        thread_count: int,
        progress: _Progress,
    ) -> QueryReport: ...
    def rays(self, receivers: Receivers, index: int) -> Tuple[_Triple, _Floats, _Words]: ...

class RayBundles:
    @staticmethod
    def make(scene: OccluderScene, sided: str, kernel: str) -> RayBundles: ...
    def blocked(
        self,
        origins: _Array,
        rays: _Floats,
        origin: _Triple,
        excluded_primitive: int,
        excluded_instance: int,
        masks: Optional[_Words],
        first_index: int,
        thread_count: int,
        progress: _Progress,
    ) -> None: ...

class SoftShadows:
    @staticmethod
    def make(
        scene: OccluderScene,
        position: _Triple,
        normal: Optional[_Triple],
        radius: float,
        pattern: SamplePattern,
        sided: str,
        rotation: float,
        seed: int,
        surface_offset: float,
        kernel: str,
    ) -> SoftShadows: ...
    def query(
        self,
        receivers: Receivers,
        visibility: Optional[_Floats],
        above_horizon: Optional[_Floats],
        masks: Optional[_Words],
        first_index: int,
        thread_count: int,
        progress: _Progress,
    ) -> QueryReport: ...

class SkyVisibility:
    @staticmethod
    def make(
        scene: OccluderScene,
        ray_count: int,
        radius: float,
        sided: str,
        seed: int,
        surface_offset: float,
        kernel: str,
    ) -> SkyVisibility: ...
    def query(
        self,
        receivers: Receivers,
        shares: Optional[_Floats],
        first_index: int,
        thread_count: int,
        progress: _Progress,
    ) -> QueryReport: ...

class Surface:
    def __init__(
        self,
        positions: _Array,
        triangles: _Array,
        origin: _Triple,
        normals: str,
        given_normals: Optional[_Floats],
        uvs: Optional[_Floats],
        materials: Optional[npt.NDArray[np.uint32]],
        holes: Optional[Holes],
    ) -> None: ...

class Baking:
    def __init__(
        self, surface: Surface, per: str, least_squares: bool, occluders: Optional[Tuple[_Triple, _Triple]]
    ) -> None: ...
    @property
    def receiver_count(self) -> int: ...
    def receivers(self) -> Tuple[_Floats, _Floats, _Floats]: ...
    def values(self, occlusion: _Floats) -> _Floats: ...

class TextureOptions:
    def __init__(
        self,
        width: int,
        height: int,
        wrap_u: str,
        wrap_v: str,
        udim: bool,
        material: Optional[int],
        grid: int,
        bent_normals: Optional[str],
        thickness: bool,
        level_seams: bool,
        margin: Optional[int],
    ) -> None: ...

class Rasterizer:
    """Only where lkao is built with OpenGL."""

    def __init__(self, device: str) -> None: ...
    @property
    def renderer(self) -> str: ...
    @property
    def is_software(self) -> bool: ...
    def set_view(
        self,
        eye: _Triple,
        target: _Triple,
        up: _Triple,
        fov: float,
        width: int,
        height: int,
        positions: _Floats,
        normals: _Floats,
        geometric_normals: _Floats,
        depth: _Floats,
    ) -> None: ...
    def set_occluders(
        self, positions: _Array, triangles: _Array, origin: _Triple, table: PlaneMaskTable, is_double: bool
    ) -> None: ...
    def draw(
        self, options: RayOptions, with_bent_normals: bool
    ) -> Tuple[_Floats, Optional[_Floats], _Words, float]: ...
