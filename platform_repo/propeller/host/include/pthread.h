/* POSIX threads of propgcc: each thread is a cog here. */
#ifndef ROBOSMI_HOST_PTHREAD_H
#define ROBOSMI_HOST_PTHREAD_H
#include <propeller.h>
#define PTHREAD_STACK_MIN 64
#define PTHREAD_CREATE_JOINABLE 0
#define PTHREAD_CREATE_DETACHED 1
#define PTHREAD_MUTEX_INITIALIZER { 0, 0 }
typedef struct robosmi_thread *pthread_t;
typedef struct { unsigned stksiz; void *stack; unsigned flags; } pthread_attr_t;
typedef int pthread_mutexattr_t, pthread_condattr_t;
typedef struct { volatile int count; void *queue; } pthread_mutex_t;
typedef struct { volatile int waiting, woken; } pthread_cond_t;
int pthread_attr_init(pthread_attr_t *attr);
int pthread_attr_destroy(pthread_attr_t *attr);
int pthread_attr_setstacksize(pthread_attr_t *attr, size_t stacksize);
int pthread_attr_setdetachstate(pthread_attr_t *attr, int detachstate);
int pthread_create(pthread_t *thread, const pthread_attr_t *attr, void *(*startfunc)(void *), void *arg);
void pthread_exit(void *value);
int pthread_join(pthread_t thread, void **result_ptr);
int pthread_detach(pthread_t thread);
pthread_t pthread_self(void);
void pthread_yield(void);
void pthread_set_affinity_thiscog_np(void);
int pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attr);
int pthread_mutex_lock(pthread_mutex_t *mutex);
int pthread_mutex_trylock(pthread_mutex_t *mutex);
int pthread_mutex_unlock(pthread_mutex_t *mutex);
int pthread_mutex_destroy(pthread_mutex_t *mutex);
int pthread_cond_init(pthread_cond_t *cond, const pthread_condattr_t *attr);
int pthread_cond_destroy(pthread_cond_t *cond);
int pthread_cond_wait(pthread_cond_t *cond, pthread_mutex_t *mutex);
int pthread_cond_signal(pthread_cond_t *cond);
int pthread_cond_broadcast(pthread_cond_t *cond);
#endif
