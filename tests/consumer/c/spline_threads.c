/* Several threads use the same curve and surface at once, the first searches on them included: each
 * must get what a single thread gets, and see its own error: spline_threads */
#include "common.h"
#include <pthread.h>

enum { THREADS = 4, ROUNDS = 4, POINTS = 20 };

struct results {
    double nearest[POINTS], lengths[POINTS], feet[3 * POINTS];
};

struct shared {
    bladesmith_curve *curve;
    bladesmith_surface *surface;
    double points[3 * POINTS], directions[3 * POINTS];
    struct results expected;
};

struct job {
    const struct shared *shared;
    int number, wrong;
};

static void make(bladesmith_curve **curve, bladesmith_surface **surface)
{
    const double centre[3] = {9, 0, 0}, x[3] = {3, 0, 0}, y[3] = {0, 0, 3}, origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
    CHECK(bladesmith_curve_arc(3, centre, x, y, 0.0, 6.0, curve));
    CHECK(bladesmith_surface_revolved(*curve, origin, axis, 6.0, surface));
}

static void search(const bladesmith_curve *curve, const bladesmith_surface *surface, const struct shared *s, struct results *out)
{
    memset(out, 0, sizeof *out);
    CHECK(bladesmith_curve_nearest(curve, s->points, POINTS, NULL, NULL, out->nearest));
    CHECK(bladesmith_surface_nearest(surface, s->points, POINTS, NULL, out->feet, NULL));
    CHECK(bladesmith_surface_first_hits(surface, s->points, s->directions, POINTS, 1e-9, out->lengths, NULL, NULL));
}

static void *work(void *argument)
{
    struct job *job = argument;
    const struct shared *shared = job->shared;
    struct results found;
    char message[64];
    for (int round = 0; round < ROUNDS; round++) {
        search(shared->curve, shared->surface, shared, &found);
        job->wrong += memcmp(&found, &shared->expected, sizeof found) != 0;
        snprintf(message, sizeof message, "is %d", 100 + job->number);
        int32_t status = bladesmith_curve_evaluate(shared->curve, shared->points, 1, 100 + job->number, 0, found.feet);
        job->wrong += status != BLADESMITH_STATUS_ARGUMENT || !strstr(bladesmith_last_error(), message);
    }
    return NULL;
}

int main(void)
{
    struct shared shared;
    struct job jobs[THREADS];
    pthread_t threads[THREADS];
    int wrong = 0;
    for (int i = 0; i < POINTS; i++) {
        const double point[3] = {1.4 * i - 14.0, 0.6 * i + 1.0, 0.2 * i - 2.0}, direction[3] = {1.0, -1.0, 0.1 * i - 1.0};
        memcpy(shared.points + 3 * i, point, sizeof point);
        memcpy(shared.directions + 3 * i, direction, sizeof direction);
    }
    make(&shared.curve, &shared.surface);
    search(shared.curve, shared.surface, &shared, &shared.expected);
    bladesmith_curve_free(shared.curve);
    bladesmith_surface_free(shared.surface);
    /* New handles, which nothing has been searched on yet. */
    make(&shared.curve, &shared.surface);
    for (int i = 0; i < THREADS; i++) {
        jobs[i] = (struct job){&shared, i, 0};
        if (pthread_create(&threads[i], NULL, work, &jobs[i]) != 0)
            return EXIT_FAILURE;
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        wrong += jobs[i].wrong;
    }
    bladesmith_curve_free(shared.curve);
    bladesmith_surface_free(shared.surface);
    if (wrong > 0)
        fprintf(stderr, "%d result(s) differ from those of one thread\n", wrong);
    return wrong > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
