/* Stress-strain curves of a fabric's fibres and of its shear: FORM 4, 14, -14 and 24 of MAT_FABRIC, MAT_FABRIC_MAP
 * (docs/theory.md, Fabric, curves). */
#ifndef BILLOW_LAW_CURVE_H
#define BILLOW_LAW_CURVE_H

#include <stdbool.h>
#include <stddef.h>

/* A piecewise linear curve through the origin, on pieces that start at x[i]; piece 0 goes left of x[1] without end, the
 * last one right. In piece i: stress y[i] + slope[i] (e - x[i]), its integral from 0 area[i] + (y[i] + ...) (e - x[i]).
 */
typedef struct LawCurve {
    int count;                    /* pieces, >= 1 */
    double *x, *y, *slope, *area; /* (count) strain [-], stress [F/L2], [F/L2], [F/L2] */
} LawCurve;

enum { CURVE_WARP, CURVE_WEFT, CURVE_SHEAR, CURVE_DIRECTIONS };

typedef struct CurveLaw {
    LawCurve load[CURVE_DIRECTIONS];   /* of the fibres 1 and 2; of the shear, for strains >= 0 */
    LawCurve unload[CURVE_DIRECTIONS]; /* count 0: none; meets load at meet_strain, below it before */
    double meet_strain[CURVE_DIRECTIONS], meet_area[CURVE_DIRECTIONS]; /* area under load up to there */
    bool engineering; /* fibres: engineering stress on engineering strain; else second Piola-Kirchhoff on Green */
    bool unloading;   /* some unload curve is there */
    double reload;    /* RL, 0 to 1 */
    double softening; /* q of (eq. F24); 0: none */
} CurveLaw;

/* What is wrong with the points of a curve. */
typedef enum CurveFault {
    CURVE_FINE,
    CURVE_TOO_SHORT,  /* fewer than two points */
    CURVE_FALLS,      /* stress falls at the point */
    CURVE_OFF_ORIGIN, /* stress at zero strain is not zero, or zero strain is not on the curve */
    CURVE_FLAT,       /* no stiffness at all */
    CURVE_NOT_ODD,    /* shear with a branch of negative strains that is not the mirror image of the other */
} CurveFault;

/* Doubles that a curve of so many points needs. */
size_t law_curve_size(int points);

/* Checks points (strains rising); *point receives the index of the bad one. */
CurveFault law_curve_check(int points, const double *x, const double *y, bool shear, int *point);

/* Makes the pieces from points that passed the check, stresses times share; tension: strains below 0 carry nothing.
 * Beyond its ends a curve goes on with the slope there. storage: law_curve_size doubles that stay. */
void law_curve_make(LawCurve *curve, int points, const double *x, const double *y, double share, bool tension,
                    double *storage);

/* A straight curve; storage: law_curve_size(1). */
void law_curve_make_line(LawCurve *curve, double modulus, bool tension, double *storage);

double law_curve_stress(const LawCurve *curve, double strain);
double law_curve_area(const LawCurve *curve, double strain); /* integral of the stress from 0 */
double law_curve_steepest(const LawCurve *curve);            /* largest slope */

/* Scales the unload curve so that it meets the loading curve at its last point; returns the factor. */
double law_curve_meet(CurveLaw *law, int direction);

/* Multiplies all stresses. */
void law_curves_scale(CurveLaw *law, double factor);

/* A strain up to the meeting point where unloading is above loading, or -1. */
double law_curve_crossing(const CurveLaw *law, int direction);

/* Bound of the tangent modulus over all states of a direction (eq. F23). */
double law_curve_tangent(const CurveLaw *law, int direction);

/* q for which a full cycle dissipates the share h of its energy, 0 <= h < 1 (eq. F24), and what the largest tangent
 * grows by (eq. F25). */
double law_softening(double h);
double law_softening_stiffer(double q);

#endif
