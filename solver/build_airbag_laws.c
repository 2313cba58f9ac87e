/* *AIRBAG cards of the models whose pressure follows a law of volume and time -> gas models. */
#include "solver/build_airbags.h"

int airbag_pressure_volume(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    PressureVolumeLaw *law = &gas->pressure_volume;
    gas->kind = GAS_PRESSURE_VOLUME;
    if (bag->cn < 0.0)
        law->coefficient_curve = airbag_curve(b, (int)bag->cn, "CN", bag->card3, &status);
    else
        law->coefficient = bag->cn;
    if (b->options->relaxation_phase && bag->lciddr != 0)
        law->coefficient_curve = airbag_curve(b, bag->lciddr, "LCIDDR", bag->card3, &status);
    law->factor = bag->beta;
    law->relative_curve = airbag_curve(b, bag->lcid, "LCID", bag->card3, &status);
    return status;
}

int airbag_adiabatic(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    gas->kind = GAS_ADIABATIC;
    gas->adiabatic.factor = bag->psf;
    gas->adiabatic.gamma = bag->gamma;
    gas->adiabatic.preload_curve = airbag_curve(b, bag->lcid, "LCID", bag->card3, &status);
    gas->overpressure = bag->p0;
    gas->ambient_pressure = bag->pe;
    gas->density = gas->ambient_density = bag->ro;
    return status;
}

int airbag_load_curve(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    gas->kind = GAS_LOAD_CURVE;
    gas->load_curve.start_time = bag->stime;
    gas->load_curve.pressure_curve = airbag_curve(b, bag->lcid, "LCID", bag->card3, &status);
    gas->load_curve.temperature = bag->t;
    gas->load_curve.zero = bag->t0;
    gas->overpressure = bag->p0;
    gas->density = gas->ambient_density = bag->ro;
    if (bag->lcid == 0) gas->ambient_pressure = bag->pe;
    return status;
}

int airbag_linear_fluid(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    LinearFluidLaw *law = &gas->fluid;
    gas->kind = GAS_LINEAR_FLUID;
    law->bulk = bag->bulk;
    gas->density = bag->ro;
    law->inflow_curve = airbag_curve(b, bag->lcint, "LCINT", bag->card3, &status);
    law->outflow_curve = airbag_curve(b, bag->lcoutt, "LCOUTT", bag->card3, &status);
    law->outflow_pressure_curve = airbag_curve(b, bag->lcoutp, "LCOUTP", bag->card3, &status);
    law->added_pressure_curve = airbag_curve(b, bag->lcfit, "LCFIT", bag->card3, &status);
    law->bulk_curve = airbag_curve(b, bag->lcbulk, "LCBULK", bag->card3, &status);
    law->pressure_curve = airbag_curve(b, bag->lcid, "LCID", bag->card3, &status);
    law->limit = bag->p_limit;
    law->limit_curve = airbag_curve(b, bag->p_limlc, "P_LIMLC", bag->card4, &status);
    return status;
}

int airbag_fluid_and_gas(Builder *b, const AirbagDefinition *bag, Airbag *airbag)
{
    GasModel *gas = &airbag->gas;
    int status = 0;
    FluidAndGasLaw *law = &gas->fluid_and_gas;
    gas->kind = GAS_FLUID_AND_GAS;
    gas->density = bag->ro;
    law->axis = (int)(bag->gdir < 0.0 ? -bag->gdir : bag->gdir) - 1;
    law->up = bag->gdir < 0.0 ? 1.0 : -1.0;
    law->initial_level = bag->xwini;
    law->level_step = bag->xwadd;
    law->final_level = bag->xw;
    law->level_curve = airbag_curve(b, bag->lcxw, "LCXW", bag->card3, &status);
    law->pressure = bag->p;
    law->end_time = bag->tend;
    law->pressure_curve = airbag_curve(b, bag->lcp, "LCP", bag->card3, &status);
    law->kappa = bag->kappa;
    law->bulk = bag->kbm;
    for (size_t i = 0; i < b->definitions->body_loads.count; i++) {
        const BodyLoadDefinition *load = &b->definitions->body_loads.items[i];
        if (load->axis != law->axis || load->cid != 0 || load->lcid <= 0) continue;
        law->gravity_curve = airbag_curve(b, load->lcid, "LCID", load->source, &status);
        law->gravity = load->sf;
    }
    b->model->has_fluid = true;
    if (law->gravity_curve < 0 && bag->ro > 0.0)
        diagnostics_add(b->diagnostics, SEVERITY_WARNING, bag->card4, "*AIRBAG",
                        "no *LOAD_BODY_%c gives the gravity along GDIR = %g: the fluid has no weight", "XYZ"[law->axis],
                        bag -> gdir);
    return status;
}
