/* The user's own airbag sensor (RBID > 0): what a shared library for billow run --sensor-library FILE provides.
 * This header stands alone; docs/user-guide.md has an example. */
#ifndef BILLOW_SENSOR_USER_H
#define BILLOW_SENSOR_USER_H

#ifdef __cplusplus
extern "C" {
#endif

enum { BILLOW_SENSOR_VERSION = 1, BILLOW_SENSOR_CONSTANTS = 25, BILLOW_SENSOR_HISTORY = 25 };

/* Motion of the rigid body's centre of mass, in the deck's units. Local components are along the body's axes, which
 * turn with it. Velocity and displacement are changes since the start, the acceleration is that of the step before. */
typedef struct BillowSensorInput {
    int version;                                          /* BILLOW_SENSOR_VERSION */
    int airbag;                                           /* id of the airbag */
    int part;                                             /* id of the rigid body's part: RBID */
    int count;                                            /* constants: N of the card */
    const double *constant;                               /* C1 ... CN */
    double time, step;                                    /* now, and the step just taken */
    double acceleration[3], velocity[3], displacement[3]; /* local */
    double global_acceleration[3], global_velocity[3], global_displacement[3];
    double axes[9]; /* local x, y, z as rows, global components */
} BillowSensorInput;

/* The function's name must be billow_airbag_sensor. It is called once a cycle for each bag whose sensor has not fired,
 * on one thread; history starts with zeros and is the function's own, one for each bag, kept in checkpoints. A value
 * other than 0 fires: the inflow's curves start at input->time. */
typedef int BillowSensorFunction(const BillowSensorInput *input, double history[BILLOW_SENSOR_HISTORY]);
BillowSensorFunction billow_airbag_sensor;
#define BILLOW_SENSOR_FUNCTION "billow_airbag_sensor"

#ifdef __cplusplus
}
#endif
#endif
