/* *AIRBAG cards -> gas models. */
#include <math.h>
#include <string.h>

#include "airbag/gas_pop.h"
#include "solver/build_airbags.h"

int airbag_curve(Builder *b, int id, const char *field, Source source, int *status)
{
    if (id == 0) return -1;
    int index = deck_index_curve(&b->index, id < 0 ? -id : id, field, source, "*AIRBAG", b->diagnostics);
    if (index < 0) *status = -1;
    return index;
}

int airbag_spline(Builder *b, int id, const char *field, Source source, int *status)
{
    int index = airbag_curve(b, id, field, source, status);
    if (index < 0 || id > 0) return index;
    index = build_spline(b, index);
    if (index < 0) *status = -1;
    return index;
}

/* The same for fields that take functions too, which are listed with the bag. *DEFINE_FUNCTION gets at most pressure,
 * volume and time. */
int airbag_exit_curve(Builder *b, Airbag *bag, int id, const char *field, Source source, int *status)
{
    if (id == 0) return -1;
    int index = deck_index_curve_or_function(&b->index, id < 0 ? -id : id, field, source, "*AIRBAG", b->diagnostics);
    int function = index - b->model->first_function;
    if (index < 0) *status = -1;
    if (function < 0) return index;
    if (b->model->functions[function].argument_count > 3) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, "*AIRBAG",
                        "%s = %d: the function has %d arguments, but gets three: pressure, volume and time", field, id,
                        b->model->functions[function].argument_count);
        *status = -1;
    }
    for (int i = 0; i < bag->function_count; i++)
        if (bag->function[i] == function) return index;
    bag->function[bag->function_count++] = function;
    return index;
}

int airbag_error(Builder *b, Source source, const char *text)
{
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, "*AIRBAG", "%s", text);
    return -1;
}

/* Heat capacities and ambient state, common to both models. */
static int common_fields(Builder *b, const AirbagDefinition *bag, GasModel *gas)
{
    gas->cv = bag->cv;
    gas->cp = bag->cp;
    gas->temperature_dependent = bag->cv == 0.0;
    gas->a = bag->a;
    gas->b = bag->b;
    gas->molar_mass = bag->mw;
    gas->gas_constant = bag->gasc;
    gas->inflow_temperature = bag->t;
    gas->ambient_pressure = bag->pe;
    gas->ambient_density = bag->ro;
    gas->ambient_temperature = bag->text;
    gas->gravity_conversion = 1.0;
    if (gas->temperature_dependent) gas->initial_temperature = bag->text;
    if (!gas->temperature_dependent && !(gas->cp > gas->cv && gas->cv > 0.0))
        return airbag_error(b, bag->card3,
                            "CP must exceed CV, both positive (or CV = 0 for capacities that depend on the "
                            "temperature)");
    if (gas->temperature_dependent && !(gas->molar_mass > 0.0 && gas->gas_constant > 0.0 && gas->a > gas->gas_constant))
        return airbag_error(b, bag->card3,
                            "CV = 0 asks for heat capacities from A, B, MW and GASC: MW and GASC must be "
                            "positive and A must exceed GASC");
    if (!(gas->ambient_pressure > 0.0) || !(gas->ambient_density > 0.0))
        return airbag_error(b, bag->model == AIRBAG_SIMPLE ? bag->card3 : bag->card5,
                            "PE and RO must be positive: they give the gas that fills the bag at the start");
    return 0;
}

int airbag_simple(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = common_fields(b, bag, gas);
    gas->kind = GAS_SIMPLE;
    gas->mass_flow_curve = airbag_curve(b, bag->lcid, "LCID", bag->card3, &status);
    gas->exit_flow_curve = airbag_curve(b, bag->lou, "LOU", bag->card4, &status);
    if (bag->mu < 0.0)
        gas->vent_coefficient_pressure_curve = airbag_curve(b, (int)bag->mu, "MU", bag->card3, &status);
    else
        gas->vent_coefficient = bag->mu;
    if (bag->area < 0.0)
        gas->vent_area_pressure_curve = airbag_curve(b, (int)bag->area, "AREA", bag->card3, &status);
    else
        gas->vent_area = bag->area;
    return status;
}

int airbag_vents(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    gas->vent_coefficient = bag->c23;
    gas->vent_area = bag->a23 > 0.0 ? bag->a23 : 0.0;
    if (bag->c23 == 0.0 && bag->lcc23 < 0)
        gas->vent_coefficient_ratio_curve = airbag_exit_curve(b, airbag, bag->lcc23, "LCC23", bag->card4, &status);
    else if (bag->c23 == 0.0)
        gas->vent_coefficient_time_curve = airbag_exit_curve(b, airbag, bag->lcc23, "LCC23", bag->card4, &status);
    if (bag->a23 == 0.0)
        gas->vent_area_pressure_curve = airbag_exit_curve(b, airbag, bag->lca23, "LCA23", bag->card4, &status);
    if (bag->opt == 0.0) {
        gas->porosity_coefficient = bag->cp23;
        gas->porosity_area = bag->ap23;
        if (bag->cp23 == 0.0)
            gas->porosity_coefficient_time_curve =
                airbag_exit_curve(b, airbag, bag->lccp23, "LCCP23", bag->card4, &status);
        if (bag->ap23 == 0.0)
            gas->porosity_area_pressure_curve =
                airbag_exit_curve(b, airbag, bag->lcap23, "LCAP23", bag->card4, &status);
    }
    return status;
}

/* LCMT. The phase before the run ignores the bag unless SIDR of the curve is 1 or 2; with 1 nothing flows in later. */
static int flow_curve(Builder *b, const AirbagDefinition *bag, Airbag *airbag, int *status)
{
    int flow = airbag_curve(b, bag->lcmt, "LCMT", bag->card3, status);
    if (flow < 0) return flow;
    int sidr = b->model->curves[flow].sidr, flag = b->definitions->control.relaxation.idrflg;
    bool phase = b->definitions->control.relaxation.given && (flag == 1 || flag == 5);
    airbag->idle = b->options->relaxation_phase && sidr == 0;
    if (b->options->relaxation_phase || !phase) return flow;
    if (sidr == 0)
        diagnostics_add(b->diagnostics, SEVERITY_NOTE, bag->card3, "*AIRBAG_WANG_NEFSKE",
                        "airbag %d has no pressure in dynamic relaxation: the curve LCMT = %d has SIDR = 0", airbag->id,
                        bag->lcmt);
    if (sidr != 1) return flow;
    diagnostics_add(b->diagnostics, SEVERITY_NOTE, bag->card3, "*AIRBAG_WANG_NEFSKE",
                    "the curve LCMT = %d acts in dynamic relaxation only (SIDR = 1): no gas flows in during the run",
                    bag->lcmt);
    return -1;
}

int airbag_wang_nefske(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = common_fields(b, bag, gas);
    gas->kind = GAS_WANG_NEFSKE;
    gas->temperature_curve = airbag_curve(b, bag->lct, "LCT", bag->card3, &status);
    gas->temperature_rate_curve = airbag_curve(b, bag->lcdt, "LCDT", bag->card3, &status);
    int flow = flow_curve(b, bag, airbag, &status);
    if (bag->tvol > 0.0)
        gas->tank_pressure_curve = flow;
    else
        gas->mass_flow_curve = flow;
    gas->tank_volume = bag->tvol;
    if (bag->lcmt == 0 && bag->lcbf > 0) {
        int burn = airbag_curve(b, bag->lcbf, "LCBF", bag->card6, &status);
        gas->inflator = (InflatorChamber){bag->ioc, bag->ioa, bag->ivol, bag->iro, bag->it, burn};
    }
    if (bag->iabt > 0.0) gas->initial_temperature = bag->iabt;
    gas->gravity_conversion = bag->gc != 0.0 ? bag->gc : 1.0;
    if (airbag_vents(b, bag, airbag)) status = -1;
    gas->exit_flow_curve = airbag_curve(b, bag->lcefr, "LCEFR", bag->card5, &status);
    gas->overpressure = bag->pover;
    gas->pop_pressure = bag->ppop;
    if (bag->hconv < 0.0)
        gas->heat_transfer_curve = airbag_curve(b, (int)bag->hconv, "HCONV", bag->card7, &status);
    else
        gas->heat_transfer = bag->hconv;
    return status;
}

/* Option POP. */
static int build_pop(Builder *b, const AirbagDefinition *d, Airbag *bag)
{
    bag->gas.pop = (PopCriterion){.delay = d->tdp,
                                  .acceleration = {d->axp, d->ayp, d->azp},
                                  .magnitude = d->amagp,
                                  .duration = d->tdurp,
                                  .acceleration_delay = d->tda};
    bag->pop_part = -1;
    if (!gas_pops_by_acceleration(&bag->gas)) return 0;
    bag->pop_part = id_map_find(&b->index.parts, d->rbidp);
    if (bag->pop_part >= 0) {
        int material = b->parts[bag->pop_part].material;
        if (material < 0 || b->definitions->materials.items[material].kind == MATERIAL_RIGID) return 0;
    }
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, d->card8, "*AIRBAG",
                    "RBIDP = %d is not a part of *MAT_RIGID: the accelerations AXP to AMAGP are those of a rigid body",
                    d->rbidp);
    return -1;
}

static int (*const build_model[])(Builder *, const AirbagDefinition *, Airbag *) = {
    [AIRBAG_SIMPLE] = airbag_simple,
    [AIRBAG_WANG_NEFSKE] = airbag_wang_nefske,
    [AIRBAG_HYBRID] = airbag_hybrid,
    [AIRBAG_CHEMKIN] = airbag_chemkin,
    [AIRBAG_PRESSURE_VOLUME] = airbag_pressure_volume,
    [AIRBAG_ADIABATIC] = airbag_adiabatic,
    [AIRBAG_LOAD_CURVE] = airbag_load_curve,
    [AIRBAG_LINEAR_FLUID] = airbag_linear_fluid,
    [AIRBAG_FLUID_AND_GAS] = airbag_fluid_and_gas,
};

static int build_airbag(Builder *b, int number)
{
    const AirbagDefinition *definition = &b->definitions->airbags.items[number];
    Airbag *bag = &b->model->airbags[number];
    bag->id = definition->id ? definition->id : number + 1;
    memcpy(bag->heading, definition->heading, sizeof bag->heading);
    bag->vsca = definition->vsca;
    bag->psca = definition->psca;
    bag->vini = definition->vini;
    bag->mwd = definition->mwd;
    bag->spsf = definition->spsf;
    bag->source = definition->source;
    if (bag->spsf > 0.0 && (definition->model == AIRBAG_PRESSURE_VOLUME || definition->model == AIRBAG_LINEAR_FLUID))
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, definition->card1, "*AIRBAG",
                        "SPSF has no effect: this model has no ambient density");
    gas_model_reset(&bag->gas);
    int status = build_model[definition->model](b, definition, bag);
    if (build_pop(b, definition, bag) || airbag_leakage(b, definition, bag)) status = -1;
    bag->ambient = bag->gas.ambient_pressure;
    if (status) return -1;
    GasState start;
    const char *why = "";
    const SurfaceClosure *closure = &b->closures[number];
    if (gas_initialize(&bag->gas, b->model->curves, bag->vsca, bag->psca, bag->vini, closure->volume, closure->area,
                       &start, &why)) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->card1, "*AIRBAG",
                        "airbag %d cannot start from its initial volume %g: %s", bag->id, closure->volume, why);
        return -1;
    }
    if (bag->gas.kind < GAS_PRESSURE_VOLUME && (start.temperature < 200.0 || start.temperature > 400.0))
        diagnostics_add(
            b->diagnostics, SEVERITY_WARNING, definition->card1, "*AIRBAG",
            "airbag %d starts at %.4g K: PE, RO and the heat capacities imply it; check their units if that is "
            "not meant",
            bag->id, start.temperature);
    return 0;
}

int build_airbags(Builder *b)
{
    int status = 0;
    for (int i = 0; i < b->model->airbag_count; i++)
        if (build_airbag(b, i)) status = -1;
    return status;
}
