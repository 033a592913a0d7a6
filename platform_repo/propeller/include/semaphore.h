/* Minimal semaphore.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SEMAPHORE_H
#define ROBOSMI_SEMAPHORE_H
#include <pthread.h>
typedef struct { int count; } sem_t;
int sem_init(sem_t *semaphore, int shared, unsigned int value);
int sem_wait(sem_t *semaphore);
int sem_trywait(sem_t *semaphore);
int sem_post(sem_t *semaphore);
int sem_getvalue(sem_t *semaphore, int *value);
int sem_destroy(sem_t *semaphore);
#endif
