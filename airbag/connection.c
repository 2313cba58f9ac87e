/* Exchange between two bags: a trapezoidal rule that turns implicit where the opening is wide. */
#include "airbag/connection.h"

#include <math.h>

#include "airbag/chamber.h"
#include "airbag/gas_law.h"
#include "airbag/gas_ledger.h"
#include "airbag/gas_vent.h"

static const double RESIDUAL = 1e-14; /* of (G44), relative to the smaller mass */

/* A transfer from one side to the other: the implicit part x of it is looked for. */
typedef struct Transfer {
    const GasConnection *connection;
    const Curve *curves;
    const GasModel *gas[2];    /* up, down */
    double mass[2], energy[2]; /* before x */
    double volume[2];
    GasLaw law[2]; /* of gases with a temperature */
    const GasState *state[2];
    double species[BILLOW_GAS_SPECIES]; /* masses downstream before x */
    double time, part_area;
    double temperature; /* of what leaves, at the last flow */
} Transfer;

static bool has_temperature(const GasModel *gas)
{
    return gas->kind < GAS_PRESSURE_VOLUME;
}

/* (G42), (G43). */
static double flow_between(Transfer *t, double high, double low, double temperature)
{
    const GasConnection *c = t->connection;
    if (!(high > low)) return 0.0;
    if (c->flow_curve >= 0) return fmax(curve_value(&t->curves[c->flow_curve], high - low), 0.0);
    double area = c->area;
    if (c->area_curve >= 0) area = curve_value(&t->curves[c->area_curve], high);
    if (c->part >= 0) area = t->part_area;
    double coefficient = chamber_value(t->curves, c->coefficient_curve, t->time, c->coefficient);
    if (!(area * coefficient > 0.0)) return 0.0;
    return coefficient * area * gas_orifice_flux(&t->law[0], t->gas[0]->gravity_conversion, low, high, temperature);
}

static double pressure_upstream(Transfer *t, double x)
{
    double rest = t->mass[0] - x;
    if (!has_temperature(t->gas[0])) return chamber_pressure(t->gas[0], t->curves, t->time, t->state[0], rest);
    t->temperature = gas_temperature(&t->law[0], t->mass[0], x, t->energy[0]);
    return rest * t->law[0].r * t->temperature / t->volume[0];
}

static double pressure_downstream(Transfer *t, double x)
{
    double mass = t->mass[1] + x;
    if (!has_temperature(t->gas[1])) return chamber_pressure(t->gas[1], t->curves, t->time, t->state[1], mass);
    double rest = t->mass[0] - x;
    double gain = t->energy[0] - rest * gas_internal_energy(&t->law[0], t->temperature);
    GasLaw *law = &t->law[1];
    if (law->count > 0) {
        double mixed[BILLOW_GAS_SPECIES];
        for (int i = 0; i < law->count; i++) mixed[i] = t->species[i] + x * t->law[0].fraction[i];
        gas_law_mix(law, mixed);
    }
    return mass * law->r * gas_temperature(law, mass, 0.0, t->energy[1] + gain) / t->volume[1];
}

/* (G44): the flow in the state that x leaves. */
static double flow_after(Transfer *t, double x)
{
    double high = pressure_upstream(t, x);
    return flow_between(t, high, pressure_downstream(t, x), t->temperature);
}

/* Root of x = span flow(x), flow falling with x; the flow at x = 0 is known. */
static double find_transfer(Transfer *t, double span, double flow)
{
    double scale = fmax(fmin(fabs(t->mass[0]), fabs(t->mass[1])), 1e-300), least = RESIDUAL * scale;
    double high = span * flow, low = 0.0, at_low = -high;
    if (has_temperature(t->gas[0]) || t->mass[0] > 0.0) high = fmin(high, t->mass[0]);
    double at_high = high - span * flow_after(t, high);
    if (fabs(at_high) <= least || at_high < 0.0) return high;
    int side = 0;
    for (int i = 0; i < 100; i++) {
        double x = low - at_low * ((high - low) / (at_high - at_low));
        if (i % 3 == 2 || !(x > low && x < high)) x = 0.5 * (low + high);
        if (!(x > low && x < high)) break;
        double value = x - span * flow_after(t, x);
        if (fabs(value) <= least) return x;
        if (value < 0.0) {
            low = x, at_low = value;
            if (side < 0) at_high *= 0.5;
            side = -1;
        } else {
            high = x, at_high = value;
            if (side > 0) at_low *= 0.5;
            side = 1;
        }
        if (high - low <= 1e-15 * high) break;
    }
    return low; /* the side on which the pressures have not crossed */
}

/* Mass that would make the pressures equal, linearised (G45). */
static double equalising_mass(const Transfer *t, double high, double low)
{
    double slope = 0.0;
    for (int i = 0; i < 2; i++) {
        const GasState *s = t->state[i];
        if (has_temperature(t->gas[i]))
            slope += gas_gamma(&t->law[i], s->temperature) * t->law[i].r *
                     fmax(t->state[0]->temperature, s->temperature) / s->volume;
        else if (s->mass > 0.0)
            slope += s->stiffness * s->volume / s->mass;
    }
    return slope > 0.0 ? (high - low) / slope : INFINITY;
}

static Transfer begin_transfer(const GasConnection *c, const Curve *curves, const GasSide *up, const GasSide *down,
                               double time, double part_area)
{
    Transfer t = {.connection = c, .curves = curves, .time = time, .part_area = part_area};
    const GasSide *sides[2] = {up, down};
    for (int i = 0; i < 2; i++) {
        const GasState *s = sides[i]->state;
        t.gas[i] = sides[i]->gas;
        t.state[i] = s;
        t.mass[i] = s->mass;
        t.energy[i] = s->energy;
        t.volume[i] = s->volume;
        if (has_temperature(t.gas[i])) t.law[i] = gas_law_of(t.gas[i], s);
    }
    for (int i = 0; i < t.law[1].count; i++) t.species[i] = down->state->species[i];
    t.temperature = up->state->temperature;
    return t;
}

/* Books what left the one side with the other, and brings both up to date. */
static void settle(Transfer *t, GasSide *up, GasSide *down, double early, double late)
{
    GasState *s = up->state, *r = down->state;
    double rest = t->mass[0] - late, moved = early + late, enthalpy = 0.0;
    const double *fraction = t->law[0].fraction;
    if (has_temperature(up->gas)) {
        double temperature = gas_temperature(&t->law[0], t->mass[0], late, t->energy[0]);
        double energy = rest * gas_internal_energy(&t->law[0], temperature);
        moved = gas_settle(&s->mass, &s->carry[CARRY_MASS], 0.0, rest);
        enthalpy = gas_settle(&s->energy, &s->carry[CARRY_ENERGY], 0.0, energy);
    } else {
        gas_book(&s->mass, &s->carry[CARRY_MASS], -moved);
    }
    for (int i = 0; i < t->law[0].count && i < t->law[1].count; i++) {
        r->species[i] += moved * fraction[i];
        s->species[i] = rest * fraction[i];
    }
    gas_book(&s->mass_out, &s->carry[CARRY_MASS_OUT], moved);
    gas_book(&s->enthalpy_out, &s->carry[CARRY_ENTHALPY_OUT], enthalpy);
    gas_book(&r->mass, &r->carry[CARRY_MASS], moved);
    gas_book(&r->energy, &r->carry[CARRY_ENERGY], enthalpy);
    gas_book(&r->mass_in, &r->carry[CARRY_MASS_IN], moved);
    gas_book(&r->enthalpy_in, &r->carry[CARRY_ENTHALPY_IN], enthalpy);
}

void gas_connect(const GasConnection *c, const Curve *curves, GasSide first, GasSide second, double time, double span,
                 double part_area)
{
    bool forward = first.state->pressure > second.state->pressure;
    if ((forward && c->direction > 0) || (!forward && c->direction < 0)) return;
    if (gas_asleep(first.gas, first.state) || gas_asleep(second.gas, second.state)) return;
    GasSide *up = forward ? &first : &second, *down = forward ? &second : &first;
    double high = up->state->pressure, low = down->state->pressure;
    Transfer t = begin_transfer(c, curves, up, down, time, part_area);
    double flow = flow_between(&t, high, low, up->state->temperature);
    if (!(flow > 0.0)) return;
    double early = fmin(0.5 * span * flow, 0.25 * equalising_mass(&t, high, low)), weight = 1.0 - early / (span * flow);
    if (has_temperature(up->gas)) {
        double enthalpy = early * gas_enthalpy(&t.law[0], up->state->temperature);
        t.energy[0] -= enthalpy;
        t.energy[1] += enthalpy;
    }
    t.mass[0] -= early;
    t.mass[1] += early;
    for (int i = 0; i < t.law[1].count; i++) t.species[i] += early * t.law[0].fraction[i];
    t.time = time + span;
    double late = 0.0, next = flow_after(&t, 0.0);
    if (next > 0.0) late = find_transfer(&t, weight * span, next);
    settle(&t, up, down, early, late);
    gas_refresh(up, curves, time + span);
    gas_refresh(down, curves, time + span);
}

double gas_connection_scale(const GasConnection *c, const Curve *curves, GasSide first, GasSide second, double time,
                            double part_area)
{
    bool forward = first.state->pressure > second.state->pressure;
    if ((forward && c->direction > 0) || (!forward && c->direction < 0)) return CHAMBER_NO_SCALE;
    if (gas_asleep(first.gas, first.state) || gas_asleep(second.gas, second.state)) return CHAMBER_NO_SCALE;
    GasSide *up = forward ? &first : &second, *down = forward ? &second : &first;
    double high = up->state->pressure, low = down->state->pressure;
    Transfer t = begin_transfer(c, curves, up, down, time, part_area);
    double flow = flow_between(&t, high, low, up->state->temperature);
    double scale = chamber_next_corner(curves, c->coefficient_curve, time, 0.0, CHAMBER_NO_SCALE);
    if (!(flow > 0.0)) return scale;
    double way = equalising_mass(&t, fmax(high, low * 1.001), low);
    return fmin(scale, 0.05 * way / flow);
}
