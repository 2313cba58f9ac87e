/* What tests of shapes against libccd share: numbers at random, a ball about a probe. */
#ifndef BILLOW_TESTS_CCD_BALL_H
#define BILLOW_TESTS_CCD_BALL_H

#include <stdint.h>
#include <string.h>

#include <ccd/ccd.h>

#include "solver/vector3.h"

static inline double random_number(double low, double high)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

typedef struct Ball {
    double centre[3], radius;
} Ball;

static inline void support_ball(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *point)
{
    const Ball *ball = object;
    double size = vector3_norm(direction->v);
    for (int k = 0; k < 3; k++) point->v[k] = ball->centre[k] + (size > 0 ? ball->radius * direction->v[k] / size : 0);
}

static inline void middle_of_ball(const void *object, ccd_vec3_t *middle)
{
    memcpy(middle->v, ((const Ball *)object)->centre, sizeof middle->v);
}

/* Of shapes about their own origin. */
static inline void middle_at_origin(const void *object, ccd_vec3_t *middle)
{
    (void)object;
    ccdVec3Set(middle, 0, 0, 0);
}

#endif
