"""Argument types of the kernel's calls: curves and surfaces."""

from ctypes import POINTER, c_double, c_size_t, c_uint32, c_void_p

_A = c_void_p  # an array, or a handle
_OUT = POINTER(c_void_p)
_N, _U, _F = c_size_t, c_uint32, c_double
_SAMPLES = (_U, _U, _A, _N, _A, _A, _A, _N)

STATUS_CALLS = {
    "bladesmith_curve_new": (_U, _U, _A, _N, _A, _A, _N, _OUT),
    "bladesmith_curve_size": (_A, POINTER(_U), POINTER(_U), POINTER(_N), POINTER(_U)),
    "bladesmith_curve_data": (_A, _N, _A, _A, _A),
    "bladesmith_curve_evaluate": (_A, _A, _N, _U, _U, _A),
    "bladesmith_curve_frames": (_A, _A, _N, _A, _A, _A),
    "bladesmith_curve_lengths": (_A, _F, _A, _N, _A),
    "bladesmith_curve_at_lengths": (_A, _F, _A, _N, _A),
    "bladesmith_curve_refine": (_A, _A, _N, _OUT),
    "bladesmith_curve_remove_knot": (_A, _F, _U, _F, _A, _OUT),
    "bladesmith_curve_elevate": (_A, _U, _OUT),
    "bladesmith_curve_reduce": (_A, _F, _A, _OUT),
    "bladesmith_curve_part": (_A, _F, _F, _OUT),
    "bladesmith_curve_reverse": (_A, _OUT),
    "bladesmith_curve_over": (_A, _F, _F, _OUT),
    "bladesmith_curve_clamp": (_A, _OUT),
    "bladesmith_curve_map": (_A, _A, _U, _OUT),
    "bladesmith_curve_join": (_A, _A, _F, _U, _OUT),
    "bladesmith_curve_bezier": (_A, _OUT),
    "bladesmith_curve_arc": (_U, _A, _A, _A, _F, _F, _OUT),
    "bladesmith_curve_conic": (_U, _A, _A, _A, _A, _F, _OUT),
    "bladesmith_parameters": (_U, _A, _N, _U, _F, _A),
    "bladesmith_curve_interpolate": (_U, _U, _A, _A, _A, _N, _A, _N, _OUT),
    "bladesmith_curve_fit": (*_SAMPLES, _A, _N, _A, _N, _OUT),
    "bladesmith_curve_smooth": (*_SAMPLES, _F, _OUT),
    "bladesmith_curve_smooth_within": (*_SAMPLES, _F, _A, _OUT),
    "bladesmith_curve_nearest": (_A, _A, _N, _A, _A, _A),
    "bladesmith_curve_nearest_all": (_A, _A, _F, _OUT),
    "bladesmith_curve_intersect": (_A, _A, _F, _OUT, _OUT),
    "bladesmith_curve_self_intersect": (_A, _F, _OUT, _OUT),
    "bladesmith_curve_ray": (_A, _A, _A, _U, _F, _OUT),
    "bladesmith_curve_offset": (_A, _F, _F, _F, _OUT, _OUT),
    "bladesmith_curves_compatible": (_OUT, _N, _OUT),
    "bladesmith_curves_count": (_A, POINTER(_N)),
    "bladesmith_curves_get": (_A, _N, _OUT),
    "bladesmith_surface_new": (_U, _U, _A, _N, _A, _N, _A, _A, _N, _OUT),
    "bladesmith_surface_size": (_A, *[POINTER(_U)] * 2, *[POINTER(_N)] * 2, POINTER(_U)),
    "bladesmith_surface_data": (_A, _N, _A, _A, _A, _A),
    "bladesmith_surface_evaluate": (_A, _A, _N, _U, _U, _U, _A),
    "bladesmith_surface_curvatures": (_A, _A, _N, _A, _A, _A),
    "bladesmith_surface_refine": (_A, _U, _A, _N, _OUT),
    "bladesmith_surface_remove_knot": (_A, _U, _F, _U, _F, _A, _OUT),
    "bladesmith_surface_elevate": (_A, _U, _U, _OUT),
    "bladesmith_surface_reduce": (_A, _U, _F, _A, _OUT),
    "bladesmith_surface_part": (_A, _U, _F, _F, _OUT),
    "bladesmith_surface_reverse": (_A, _U, _OUT),
    "bladesmith_surface_swap": (_A, _OUT),
    "bladesmith_surface_clamp": (_A, _OUT),
    "bladesmith_surface_map": (_A, _A, _OUT),
    "bladesmith_surface_isocurve": (_A, _U, _F, _OUT),
    "bladesmith_surface_ruled": (_A, _A, _OUT),
    "bladesmith_surface_revolved": (_A, _A, _A, _F, _OUT),
    "bladesmith_surface_coons": (_OUT, _OUT),
    "bladesmith_surface_skin": (_OUT, _A, _N, _U, _OUT),
    "bladesmith_surface_nearest": (_A, _A, _N, _A, _A, _A),
    "bladesmith_surface_nearest_all": (_A, _A, _F, _OUT),
    "bladesmith_surface_ray": (_A, _A, _A, _U, _F, _OUT),
    "bladesmith_surface_offset": (_A, _F, _F, _A, _OUT),
    "bladesmith_table_size": (_A, POINTER(_N), POINTER(_N)),
    "bladesmith_table_data": (_A, _N, _A),
}
"""Argument types of the calls that return a status."""

OTHER_CALLS = {
    f"bladesmith_{noun}_free": (None, (c_void_p,))
    for noun in ("curve", "curves", "surface", "table")
}
"""Result and argument types of the other calls."""
