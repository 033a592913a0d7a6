/* Threads of propgcc: the names that programs use to size stacks. */
#ifndef ROBOSMI_SYS_THREAD_H
#define ROBOSMI_SYS_THREAD_H
typedef struct { int registers[40]; } _thread_state_t;
typedef volatile int atomic_t;
int _start_cog_thread(char *stack_top, void (*function)(void *), void *parameter, _thread_state_t *state);
#endif
