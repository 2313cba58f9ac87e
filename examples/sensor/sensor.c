/* An airbag sensor of one's own (RBID > 0): fires once the deceleration along the local x axis, smoothed over a time of
 * C2, reaches C1.
 *
 *     cc -shared -fPIC -O2 -I PATH/TO/billow -o sensor.so sensor.c
 *     billow run deck.k --sensor-library ./sensor.so
 */
#include "airbag/billow_sensor.h"

int billow_airbag_sensor(const BillowSensorInput *input, double history[BILLOW_SENSOR_HISTORY])
{
    double level = input->constant[0], window = input->constant[1];
    if (input->version != BILLOW_SENSOR_VERSION || input->count < 2 || window <= 0.0) return 0;
    double share = input->step / window; /* history[0]: the smoothed deceleration */
    history[0] += (share < 1.0 ? share : 1.0) * (-input->acceleration[0] - history[0]);
    return history[0] >= level;
}
