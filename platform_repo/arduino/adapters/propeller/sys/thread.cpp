//# header sys/thread.h
// Threads of C on cogs. Read from propgcc b280e7a77, lib/include/sys/thread.h and lib/sys/propeller/cogthread.c.

//# type _thread_state_t
//#   fidelity: holds nothing here: a thread is known by the number of its cog
struct _thread_state_t {};

//# adapter _start_cog_thread
//#   for: int _start_cog_thread(void *stacktop, void (*func)(void *), void *arg, _thread_state_t *tls)
//#   kind: semantic
//#   needs: _thread_state_t propeller.h/cog_start
//#   fidelity: the number of the cog, -1 when none is free; it runs whenever the others wait
//#   limit: the memory given is not used: each cog has a stack of COG_STACK bytes of its own
//#   stack: 14 2
inline int32_t _start_cog_thread(void *stacktop, void (*func)(void *), void *arg, _thread_state_t *tls) {
  (void)stacktop;
  (void)tls;
  return cog_start(func, arg);
}
