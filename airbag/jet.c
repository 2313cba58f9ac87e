/* The jet of an inflator. Equations (J2) to (J9) of docs/theory.md. */
#include "airbag/jet.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "solver/elementary.h"
#include "solver/vector3.h"

static const double PI = 3.14159265358979323846;
static const double DEGREES = 57.295779513082321;
static const double WEAK = 5.0; /* (r/(alpha z))^2 beyond which nothing is left: e^-10 of the peak, 5e-5 of the force */

static double value_or_curve(double constant, int curve, const Curve *curves, double time)
{
    return curve < 0 ? constant : curve_value(&curves[curve], time);
}

/* LCJRV at an angle in degrees, 0 beyond the cut-off. */
static double relative_velocity(const Jet *jet, const Curve *curves, double degrees)
{
    if (degrees > jet->cut_off) return 0.0;
    return fmax(curve_value(&curves[jet->velocity_curve], degrees), 0.0);
}

/* Simpson's rule on intervals of a twentieth of a degree. */
void jet_spread(Jet *jet, const Curve *curves)
{
    const int count = 3600;
    double end = fmin(jet->cut_off, 180.0), width = end / count;
    memset(jet->spread, 0, sizeof jet->spread);
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < 3; j++) {
            double degrees = width * (i + 0.5 * j), angle = degrees / DEGREES;
            double weight = (j == 1 ? 4.0 : 1.0) * width / DEGREES / 6.0, f = relative_velocity(jet, curves, degrees);
            double sine = elementary_sin(angle);
            jet->spread[0][0] += weight * f * sine;
            jet->spread[0][1] += weight * f;
            jet->spread[1][0] += weight * f * f * sine;
            jet->spread[1][1] += weight * f * f;
        }
    }
}

static void place(const Jet *jet, const double *x, JetFrame *frame)
{
    const double *focus = jet->focus, *head = jet->head, *second = jet->second;
    if (jet->moving) {
        focus = x + 3 * (ptrdiff_t)jet->focus_node;
        head = x + 3 * (ptrdiff_t)jet->head_node;
        if (jet->wedge) second = x + 3 * (ptrdiff_t)jet->second_node;
    }
    memcpy(frame->focus, focus, sizeof frame->focus);
    vector3_subtract(head, focus, frame->axis);
    frame->active = vector3_normalize(frame->axis) > 0.0;
    if (!jet->wedge) return;
    vector3_subtract(second, focus, frame->across);
    double along = vector3_dot(frame->across, frame->axis);
    for (int k = 0; k < 3; k++) frame->across[k] -= along * frame->axis[k];
    frame->distance = vector3_normalize(frame->across);
}

JetFrame jet_frame(const Jet *jet, const Curve *curves, const double *x, const GasJet *gas, double time)
{
    JetFrame frame = {.knock = 1.0};
    if (!(gas->mass_flow > 0.0)) return frame;
    frame.angle = value_or_curve(jet->angle, jet->angle_curve, curves, time);
    frame.strength = value_or_curve(jet->efficiency, jet->efficiency_curve, curves, time) / gas->conversion;
    frame.strength *= jet->same_momentum ? gas->mass_flow * gas->speed                     /* (J2) */
                                         : gas->mass_flow * gas->mass_flow / gas->density; /* (J3) */
    if (jet->knock_curve >= 0) frame.knock = curve_value(&curves[jet->knock_curve], time);
    place(jet, x, &frame);
    return frame;
}

/* (J5) to (J7): a cone, or a wedge between two. */
static double cone_shape(const Jet *jet, const JetFrame *frame, double z, double r, double area)
{
    double width = frame->angle * z;
    if (!(width > 0.0)) return 0.0;
    double exponent = (r / width) * (r / width);
    if (exponent > WEAK) return 0.0;
    double section = (jet->same_momentum ? 0.5 : 1.0) * PI * width * width;
    double reach = fmax(section + frame->distance * sqrt(section), area);
    double profile = elementary_exp(-2.0 * exponent);
    return profile / (jet->same_momentum ? reach : reach * reach);
}

/* (J8), (J9): velocity over the angle. */
static double multiple_shape(const Jet *jet, const Curve *curves, const JetFrame *frame, double z, double r,
                             double area)
{
    double f = relative_velocity(jet, curves, elementary_atan2(r, z) * DEGREES), radius2 = z * z + r * r;
    if (!(f > 0.0)) return 0.0;
    const double *spread = jet->spread[jet->same_momentum ? 1 : 0];
    double reach = 2.0 * PI * radius2 * spread[0] + 2.0 * frame->distance * sqrt(radius2) * spread[1];
    reach = fmax(reach, area);
    return f * f / (jet->same_momentum ? reach : reach * reach);
}

void jet_origin(const JetFrame *frame, const double point[3], double origin[3])
{
    double away[3];
    vector3_subtract(point, frame->focus, away);
    double along = vector3_dot(away, frame->across);
    along = along > 0.0 ? along < frame->distance ? along : frame->distance : 0.0;
    for (int k = 0; k < 3; k++) origin[k] = frame->focus[k] + along * frame->across[k];
}

double jet_shape(const Jet *jet, const Curve *curves, const JetFrame *frame, const double point[3],
                 const double origin[3], double area)
{
    double away[3], off[3];
    vector3_subtract(point, origin, away);
    double z = vector3_dot(away, frame->axis); /* (J4) */
    for (int k = 0; k < 3; k++) off[k] = away[k] - z * frame->axis[k];
    double r = vector3_norm(off);
    return jet->multiple ? multiple_shape(jet, curves, frame, z, r, area) : cone_shape(jet, frame, z, r, area);
}
