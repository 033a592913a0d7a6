/* pthread.h: each thread is a cog. More threads than there are cogs, which propgcc's library takes turns with, are not modelled,
 * and a thread that has ended and that nobody joined loses its result when its cog begins another.
 * Source: propgcc, lib/pthread. */
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { THREADS = 8 };
static struct robosmi_thread {
  volatile int used, ended, detached;
  void *(*code)(void *);
  void *value;  /* its argument, then its result */
} threads[THREADS];

pthread_t pthread_self(void) {
  threads[host_self()].used = 1;
  return &threads[host_self()];
}

static void finish(void *value) {
  struct robosmi_thread *self = pthread_self();
  self->value = value;
  self->ended = 1;
  if (self->detached) self->used = 0;
}

/* A cog begins some 100 us after it was started: what it is to do is known by then. */
static void body(void *unused) {
  (void)unused;
  finish(threads[host_self()].code(threads[host_self()].value));
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attr, void *(*startfunc)(void *), void *arg) {
  int detached = attr && attr->flags & PTHREAD_CREATE_DETACHED;
  host_call();
  pthread_self();
  int place = host_start(body, 0, -1);
  if (place < 0) host_unmodelled("pthread_create with more threads than cogs");
  threads[place] = (struct robosmi_thread){1, 0, detached, startfunc, arg};
  *thread = &threads[place];
  return 0;
}

void pthread_exit(void *value) {
  finish(value);
  host_stop(host_self());
}

int pthread_join(pthread_t thread, void **result_ptr) {
  while (!thread->ended) host_call();
  if (result_ptr) *result_ptr = thread->value;
  thread->used = 0;
  return 0;
}

int pthread_detach(pthread_t thread) {
  host_call();
  thread->detached = 1;
  if (thread->ended) thread->used = 0;
  return 0;
}

void pthread_yield(void) { host_call(); }
void pthread_set_affinity_thiscog_np(void) { host_call(); }

int pthread_attr_init(pthread_attr_t *attr) {
  memset(attr, 0, sizeof *attr);
  return 0;
}

int pthread_attr_destroy(pthread_attr_t *attr) { return attr ? 0 : EINVAL; }

int pthread_attr_setstacksize(pthread_attr_t *attr, size_t stacksize) {
  attr->stksiz = stacksize;
  return 0;
}

int pthread_attr_setdetachstate(pthread_attr_t *attr, int detachstate) {
  attr->flags = detachstate;
  return 0;
}

int pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attr) {
  (void)attr;
  memset(mutex, 0, sizeof *mutex);
  return 0;
}

int pthread_mutex_destroy(pthread_mutex_t *mutex) { return mutex ? 0 : EINVAL; }

int pthread_mutex_trylock(pthread_mutex_t *mutex) {
  host_call();
  if (mutex->count) return 16;  /* EBUSY */
  mutex->count = 1;
  return 0;
}

int pthread_mutex_lock(pthread_mutex_t *mutex) {
  while (pthread_mutex_trylock(mutex)) {}
  return 0;
}

int pthread_mutex_unlock(pthread_mutex_t *mutex) {
  mutex->count = 0;
  host_call();
  return 0;
}

int pthread_cond_init(pthread_cond_t *cond, const pthread_condattr_t *attr) {
  (void)attr;
  memset(cond, 0, sizeof *cond);
  return 0;
}

int pthread_cond_destroy(pthread_cond_t *cond) { return cond ? 0 : EINVAL; }

int pthread_cond_wait(pthread_cond_t *cond, pthread_mutex_t *mutex) {
  cond->waiting++;
  pthread_mutex_unlock(mutex);
  while (!cond->woken) host_call();
  cond->woken--;
  cond->waiting--;
  return pthread_mutex_lock(mutex);
}

int pthread_cond_signal(pthread_cond_t *cond) {
  host_call();
  if (cond->woken < cond->waiting) cond->woken++;
  return 0;
}

int pthread_cond_broadcast(pthread_cond_t *cond) {
  host_call();
  cond->woken = cond->waiting;
  return 0;
}
