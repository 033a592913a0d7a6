//# header stacktest.h
// How much stack a cog uses. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Utility/libstacktest.
// The amount is that of this board, whose calls and numbers take other room than those of the Propeller.

//# adapter cog_runStackTest
//#   for: int *cog_runStackTest(void (*function)(void *par), int stacksize)
//#   kind: semantic
//#   needs: simpletools.h/CogInfo simpletools.h/cog_run
//#   fidelity: as cog_run
//#   limit: the size of the stack is not used: each cog has COG_STACK bytes
//#   stack: 7 2
inline CogInfo cog_runStackTest(void (*function)(void *par), int32_t stacksize) {
  return cog_run(function, stacksize);
}

//# adapter cog_endStackTest
//#   for: int cog_endStackTest(int *coginfo)
//#   kind: semantic
//#   needs: propeller.h/cog_stack_used simpletools.h/cog_end
//#   fidelity: the most that the cog had on its stack, in ints of 4 bytes; 0 without a cog
//#   stack: 75 65
template <class Number>
inline int32_t cog_endStackTest(Number *coginfo) {
  int32_t number = coginfo ? *coginfo - 1 : 0;
  if (number < 1) return 0;
  uint16_t used = cog_stack_used((uint8_t)number);
  cog_end(coginfo);
  return (used + 3) / 4;
}

//# adapter cogstart_stackTest
//#   for: int cogstart_stackTest(void (*func)(void *), void *par, void *stack, size_t stacksize)
//#   kind: semantic
//#   needs: propeller.h/cogstart
//#   fidelity: as cogstart
//#   limit: the memory given is not used: each cog has a stack of COG_STACK bytes of its own
//#   stack: 14 2
inline int32_t cogstart_stackTest(void (*func)(void *), void *par, void *stack, uint32_t stacksize) {
  return cogstart(func, par, stack, stacksize);
}

//# adapter cogstop_stackTest
//#   for: int cogstop_stackTest(int cog, void *stack)
//#   kind: semantic
//#   needs: propeller.h/COG_SLOTS propeller.h/cog_stack_used propeller.h/cogstop
//#   fidelity: the most that the cog had on its stack, in ints of 4 bytes; 0 without a cog
//#   stack: 75 65
inline int32_t cogstop_stackTest(int32_t cog, void *stack) {
  (void)stack;
  if (cog < 1 || cog > COG_SLOTS) return 0;
  cogstop(cog);
  return (cog_stack_used((uint8_t)cog) + 3) / 4;
}
