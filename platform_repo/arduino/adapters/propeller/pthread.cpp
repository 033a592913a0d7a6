//# header pthread.h
// POSIX threads. Read from propgcc b280e7a77, lib/include/pthread.h and lib/pthread. Each thread is a cog here, with a stack of its own.

//# helper Thread
//#   fidelity: what is known of a thread as long as nobody joined it
struct Thread {
  void *(*code)(void *);
  void *value;  // its argument, then its result
  bool used, ended, detached;
  void *kept[4];  // by key
};

//# helper threads
//#   needs: Thread propeller.h/COG_SLOTS
//#   fidelity: the thread of each cog; 0 is main
//#   ram: 30
static Thread threads[COG_SLOTS + 1];

//# type pthread_t
//#   needs: Thread
//#   fidelity: a handle, as there
#define pthread_t own_pthread_t  // the C library of this target has another type of the name
typedef Thread *pthread_t;

//# type pthread_t
//#   architecture: avr
//#   needs: Thread
//#   fidelity: a handle, as there
typedef Thread *pthread_t;

//# type pthread_attr_t
//#   fidelity: the size of a stack is kept and not used
#define pthread_attr_t own_pthread_attr_t  // the C library of this target has another type of the name
struct pthread_attr_t {
  uint32_t stksiz;
  void *stack;
  uint32_t flags;
};

//# type pthread_attr_t
//#   architecture: avr
//#   fidelity: the size of a stack is kept and not used
struct pthread_attr_t {
  uint32_t stksiz;
  void *stack;
  uint32_t flags;
};

//# type pthread_mutexattr_t
//#   fidelity: exact
#define pthread_mutexattr_t own_pthread_mutexattr_t  // the C library of this target has another type of the name
typedef int32_t pthread_mutexattr_t;

//# type pthread_mutexattr_t
//#   architecture: avr
//#   fidelity: exact
typedef int32_t pthread_mutexattr_t;

//# type pthread_mutex_t
//#   fidelity: locked or not
#define pthread_mutex_t own_pthread_mutex_t  // the C library of this target has another type of the name
struct pthread_mutex_t {
  uint8_t locked;
  uint8_t unused;
};

//# type pthread_mutex_t
//#   architecture: avr
//#   fidelity: locked or not
struct pthread_mutex_t {
  uint8_t locked;
  uint8_t unused;
};

//# type pthread_condattr_t
//#   fidelity: exact
#define pthread_condattr_t own_pthread_condattr_t  // the C library of this target has another type of the name
typedef int32_t pthread_condattr_t;

//# type pthread_condattr_t
//#   architecture: avr
//#   fidelity: exact
typedef int32_t pthread_condattr_t;

//# type pthread_cond_t
//#   fidelity: how many wait, and how many of them may go on
#define pthread_cond_t own_pthread_cond_t  // the C library of this target has another type of the name
struct pthread_cond_t {
  uint8_t waiting;
  uint8_t woken;
};

//# type pthread_cond_t
//#   architecture: avr
//#   fidelity: how many wait, and how many of them may go on
struct pthread_cond_t {
  uint8_t waiting;
  uint8_t woken;
};

//# type pthread_key_t
//#   fidelity: exact
#define pthread_key_t own_pthread_key_t  // the C library of this target has another type of the name
typedef uint8_t pthread_key_t;

//# type pthread_key_t
//#   architecture: avr
//#   fidelity: exact
typedef uint8_t pthread_key_t;

//# constant PTHREAD_MUTEX_INITIALIZER
#define PTHREAD_MUTEX_INITIALIZER {0, 0}

//# constant PTHREAD_STACK_MIN
#define PTHREAD_STACK_MIN 64L

//# constant PTHREAD_CREATE_JOINABLE
#undef PTHREAD_CREATE_JOINABLE
#define PTHREAD_CREATE_JOINABLE 0

//# constant PTHREAD_CREATE_DETACHED
#undef PTHREAD_CREATE_DETACHED
#define PTHREAD_CREATE_DETACHED 1

//# adapter pthread_attr_init
//#   for: int pthread_attr_init(pthread_attr_t *attr)
//#   kind: oneToOne
//#   needs: pthread_attr_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_attr_init(pthread_attr_t *attr) {
  *attr = {512, 0, 0};
  return 0;
}

//# adapter pthread_attr_destroy
//#   for: int pthread_attr_destroy(pthread_attr_t *attr)
//#   kind: oneToOne
//#   needs: pthread_attr_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_attr_destroy(pthread_attr_t *attr) {
  *attr = {0, 0, 0};
  return 0;
}

//# adapter pthread_attr_setstacksize
//#   for: int pthread_attr_setstacksize(pthread_attr_t *attr, size_t stacksize)
//#   kind: semantic
//#   needs: pthread_attr_t
//#   fidelity: the size is kept
//#   limit: a thread has a stack of COG_STACK bytes, whatever is asked for
//#   stack: 0
inline int32_t pthread_attr_setstacksize(pthread_attr_t *attr, uint32_t stacksize) {
  attr->stksiz = stacksize;
  return 0;
}

//# adapter pthread_attr_setdetachstate
//#   for: int pthread_attr_setdetachstate(pthread_attr_t *attr, int detachstate)
//#   kind: oneToOne
//#   needs: pthread_attr_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_attr_setdetachstate(pthread_attr_t *attr, int32_t detachstate) {
  attr->flags = detachstate;
  return 0;
}

//# helper thread_end
//#   needs: threads propeller.h/cog_table propeller.h/cog_stop Thread
//#   fidelity: what the thread gave back is kept for the one that joins it
inline void thread_end(void *value) {
  Thread &thread = threads[cog_table.now];
  thread.value = value;
  thread.ended = true;
  if (thread.detached) thread.used = false;
  cog_stop(cog_table.now);
}

//# helper thread_main
//#   needs: thread_end propeller.h/cog_table Thread threads
//#   fidelity: a thread ends with what its function gives back
inline void thread_main(void *) {
  Thread &thread = threads[cog_table.now];
  thread_end(thread.code(thread.value));
}

//# adapter pthread_create
//#   for: int pthread_create(pthread_t *thread, const pthread_attr_t *attr, void *(startfunc)(void *), void *arg)
//#   kind: semantic
//#   needs: pthread_t pthread_attr_t threads thread_main propeller.h/cog_begin propeller.h/COG_SLOTS Thread
//#   fidelity: runs whenever the others wait; 11 (EAGAIN) when no thread is free
//#   limit: there are as many threads as the migration counted, each with a stack of COG_STACK bytes
//#   stack: 14 5
inline int32_t pthread_create(pthread_t *thread, const pthread_attr_t *attr, void *(*startfunc)(void *), void *arg) {
  for (uint8_t number = 1; number <= COG_SLOTS; number++) {
    if (threads[number].used || !cog_begin(number, thread_main, 0)) continue;
    threads[number] = Thread{startfunc, arg, true, false, attr && (attr->flags & 1), {0, 0, 0, 0}};
    *thread = &threads[number];
    return 0;
  }
  return 11;
}

//# adapter pthread_exit
//#   for: void pthread_exit(void *value)
//#   kind: semantic
//#   needs: thread_end
//#   fidelity: exact
//#   stack: 75 65
inline void pthread_exit(void *value) {
  thread_end(value);
}

//# adapter pthread_join
//#   for: int pthread_join(pthread_t thread, void **result_ptr)
//#   kind: semantic
//#   needs: pthread_t propeller.h/yield Thread
//#   fidelity: exact; 22 (EINVAL) for a thread that is detached
//#   stack: 65
inline int32_t pthread_join(pthread_t thread, void **result_ptr) {
  if (thread->detached) return 22;
  while (!thread->ended) yield();
  if (result_ptr) *result_ptr = thread->value;
  thread->used = false;
  return 0;
}

//# adapter pthread_detach
//#   for: int pthread_detach(pthread_t thread)
//#   kind: semantic
//#   needs: pthread_t Thread
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_detach(pthread_t thread) {
  thread->detached = true;
  if (thread->ended) thread->used = false;
  return 0;
}

//# adapter pthread_self
//#   for: pthread_t pthread_self(void)
//#   kind: semantic
//#   needs: pthread_t threads propeller.h/cog_table
//#   fidelity: exact
//#   stack: 0
inline pthread_t pthread_self() {
  return &threads[cog_table.now];
}

//# adapter pthread_yield
//#   for: void pthread_yield(void)
//#   kind: oneToOne
//#   needs: propeller.h/yield
//#   fidelity: exact
//#   stack: 65
inline void pthread_yield() {
  yield();
}

//# adapter pthread_set_affinity_thiscog_np
//#   for: void pthread_set_affinity_thiscog_np(void)
//#   kind: semantic
//#   fidelity: nothing to be done: a thread stays on its cog
//#   stack: 0
inline void pthread_set_affinity_thiscog_np() {}

//# adapter pthread_mutex_init
//#   for: int pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attr)
//#   kind: semantic
//#   needs: pthread_mutex_t pthread_mutexattr_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attr) {
  (void)attr;
  *mutex = {0, 0};
  return 0;
}

//# adapter pthread_mutex_lock
//#   for: int pthread_mutex_lock(pthread_mutex_t *mutex)
//#   kind: semantic
//#   needs: pthread_mutex_t propeller.h/yield
//#   fidelity: exact; of several that wait any may be next
//#   stack: 65
inline int32_t pthread_mutex_lock(pthread_mutex_t *mutex) {
  while (mutex->locked) yield();
  mutex->locked = 1;
  return 0;
}

//# adapter pthread_mutex_trylock
//#   for: int pthread_mutex_trylock(pthread_mutex_t *mutex)
//#   kind: semantic
//#   needs: pthread_mutex_t
//#   fidelity: exact; 16 (EBUSY) when it is locked
//#   stack: 0
inline int32_t pthread_mutex_trylock(pthread_mutex_t *mutex) {
  if (mutex->locked) return 16;
  mutex->locked = 1;
  return 0;
}

//# adapter pthread_mutex_unlock
//#   for: int pthread_mutex_unlock(pthread_mutex_t *mutex)
//#   kind: semantic
//#   needs: pthread_mutex_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_mutex_unlock(pthread_mutex_t *mutex) {
  mutex->locked = 0;
  return 0;
}

//# adapter pthread_mutex_destroy
//#   for: int pthread_mutex_destroy(pthread_mutex_t *mutex)
//#   kind: semantic
//#   needs: pthread_mutex_t
//#   fidelity: exact; 16 (EBUSY) when it is locked
//#   stack: 0
inline int32_t pthread_mutex_destroy(pthread_mutex_t *mutex) {
  return mutex->locked ? 16 : 0;
}

//# adapter pthread_cond_init
//#   for: int pthread_cond_init(pthread_cond_t *cond, const pthread_condattr_t *attr)
//#   kind: semantic
//#   needs: pthread_cond_t pthread_condattr_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_cond_init(pthread_cond_t *cond, const pthread_condattr_t *attr) {
  (void)attr;
  *cond = {0, 0};
  return 0;
}

//# adapter pthread_cond_destroy
//#   for: int pthread_cond_destroy(pthread_cond_t *cond)
//#   kind: semantic
//#   needs: pthread_cond_t
//#   fidelity: exact; 16 (EBUSY) while somebody waits
//#   stack: 0
inline int32_t pthread_cond_destroy(pthread_cond_t *cond) {
  return cond->waiting ? 16 : 0;
}

//# adapter pthread_cond_wait
//#   for: int pthread_cond_wait(pthread_cond_t *cond, pthread_mutex_t *mutex)
//#   kind: semantic
//#   needs: pthread_cond_t pthread_mutex_lock pthread_mutex_unlock propeller.h/yield pthread_mutex_t
//#   fidelity: exact; of several that wait any may be next
//#   stack: 71 65
inline int32_t pthread_cond_wait(pthread_cond_t *cond, pthread_mutex_t *mutex) {
  cond->waiting++;
  pthread_mutex_unlock(mutex);
  while (!cond->woken) yield();
  cond->woken--;
  cond->waiting--;
  return pthread_mutex_lock(mutex);
}

//# adapter pthread_cond_signal
//#   for: int pthread_cond_signal(pthread_cond_t *cond)
//#   kind: semantic
//#   needs: pthread_cond_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_cond_signal(pthread_cond_t *cond) {
  if (cond->woken < cond->waiting) cond->woken++;
  return 0;
}

//# adapter pthread_cond_broadcast
//#   for: int pthread_cond_broadcast(pthread_cond_t *cond)
//#   kind: semantic
//#   needs: pthread_cond_t
//#   fidelity: exact
//#   stack: 0
inline int32_t pthread_cond_broadcast(pthread_cond_t *cond) {
  cond->woken = cond->waiting;
  return 0;
}
