"""The numbers of the tables of the paper, "New Computation of Normal Vector and Curvature", as it prints them."""

# Table 1: the curvature by parabolas at the vertices of regular polygons in the unit circle, and its inverse.
TABLE_1 = {3: ("4.00", "0.25"), 4: ("2.00", "0.50"), 5: ("1.53", "0.65"), 6: ("1.33", "0.75"), 100: ("1.00", "1.00")}

# Table 2: mean error of normals on subdivided tetrahedra.
TABLE_2_VERTICES = (10, 34, 130, 514, 2050)
TABLE_2 = {
    "N_G": ("0.00E-08", "7.25E-03", "1.48E-03", "3.41E-04", "7.00E-05"),
    "N_T": ("0.00E-08", "3.57E-03", "6.98E-04", "1.35E-04", "2.50E-05"),
    "N_M": ("0.00E-08", "1.42E-02", "2.89E-03", "6.47E-04", "1.31E-04"),
    "N_C": ("0.00E-08", "7.42E-04", "3.57E-04", "9.30E-05", "2.00E-05"),
    "N_CM": ("0.00E-08", "5.22E-04", "1.41E-04", "3.10E-05", "6.00E-06"),
}

# Table 3: the same on spheres by longitude and latitude.
TABLE_3_VERTICES = (23, 50, 122, 262, 578)
TABLE_3 = {
    "N_G": ("4.03E-03", "7.86E-04", "2.22E-04", "5.20E-05", "2.40E-05"),
    "N_T": ("1.41E-03", "5.54E-04", "1.11E-04", "6.00E-05", "6.00E-06"),
    "N_M": ("8.87E-03", "1.96E-03", "5.88E-04", "6.30E-04", "6.30E-05"),
    "N_C": ("1.77E-03", "1.11E-03", "1.11E-04", "5.00E-05", "5.00E-06"),
    "N_CM": ("7.89E-04", "4.63E-04", "5.70E-05", "1.60E-05", "2.00E-06"),
}
# The cells of table 3 that no formula tried gives; every other cell is reproduced to the printed digits.
OPEN_CELLS = {("N_M", count) for count in TABLE_3_VERTICES} | {("N_T", 262), ("N_C", 262), ("N_C", 578)}


def six_decimals(error):
    """An error as tables 2 and 3 print it: they hold six decimals, whatever the exponent says of more."""
    return f"{round(error, 6):.2E}"
