/* Scene decks: ideal gases and the airbag cards. */
#include "examples/scene.h"

double scene_gas_constant(const SceneGas *gas)
{
    return 8.314462618 / gas->molar_mass;
}

SceneGas scene_air(double pressure, double temperature)
{
    return (SceneGas){.gamma = 1.4, .molar_mass = 0.028964, .pressure = pressure, .temperature = temperature};
}

typedef struct HeatCapacities {
    double cv, cp, density, inflow; /* inflow: T of the card, which must be positive even where nothing flows in */
} HeatCapacities;

static HeatCapacities find_capacities(const SceneGas *gas)
{
    double r = scene_gas_constant(gas), cv = r / (gas->gamma - 1);
    double inflow = gas->inflow_temperature > 0 ? gas->inflow_temperature : gas->temperature;
    return (HeatCapacities){cv, cv + r, gas->pressure / (r * gas->temperature), inflow};
}

void scene_write_simple_airbag(SceneText *deck, int part_set, const SceneGas *gas)
{
    HeatCapacities heat = find_capacities(gas);
    scene_print(deck, "*AIRBAG_SIMPLE_AIRBAG_MODEL\n");
    scene_print(deck, "$      sid    sidtyp      rbid      vsca      psca      vini       mwd      spsf\n");
    SCENE_CARD(deck, part_set, 1, 0, 1, 1, gas->vini, 0, 0);
    scene_print(deck, "$       cv        cp         t      lcid        mu      area        pe        ro\n");
    SCENE_CARD(deck, heat.cv, heat.cp, heat.inflow, gas->inflow_curve, gas->vent_coefficient, gas->vent_area,
               gas->pressure, heat.density);
    scene_print(deck, "$      lou\n");
    SCENE_CARD(deck, 0);
}

void scene_write_wang_nefske(SceneText *deck, int part_set, const SceneGas *gas)
{
    HeatCapacities heat = find_capacities(gas);
    scene_print(deck, "*AIRBAG_WANG_NEFSKE\n");
    scene_print(deck, "$      sid    sidtyp      rbid      vsca      psca      vini       mwd      spsf\n");
    SCENE_CARD(deck, part_set, 1, 0, 1, 1, gas->vini, 0, 0);
    scene_print(deck, "$       cv        cp         t       lct      lcmt      tvol      lcdt      iabt\n");
    SCENE_CARD(deck, heat.cv, heat.cp, heat.inflow, 0, gas->inflow_curve, 0, 0, gas->initial_temperature);
    scene_print(deck, "$      c23     lcc23       a23     lca23      cp23    lccp23      ap23    lcap23\n");
    SCENE_CARD(deck, gas->vent_coefficient, 0, gas->vent_area, gas->vent_curve, 0, 0, 0, 0);
    scene_print(deck, "$       pe        ro        gc     lcefr     pover      ppop       opt     knkdn\n");
    SCENE_CARD(deck, gas->pressure, heat.density, 1, 0, gas->overpressure, gas->pop_pressure, 0, 0);
    scene_print(deck, "$      ioc       ioa      ivol       iro        it      lcbf\n");
    SCENE_CARD(deck, 0, 0, 0, 0, 0, 0);
}
