/* == SR: requester.cpp, requester_sessions.cpp ==================================== */
inline sr_end(b, tells, is_fault) { /* requester::end */
  assert(at[b] >= STARTING && session[b] != 0);
  assert(!(closed_here & BIT(session[b])));
#if FALLBACK
  assert(at[b] != REMOTE || (b != 0 && at[0] == REMOTE) || (b != 1 && at[1] == REMOTE) ||
         (b != 2 && at[2] == REMOTE) || (in_use & ~BIT(session[b]) & ~closed_here) == 0);
#endif
  closed_here = closed_here | BIT(session[b]);
  to_rm!END(session[b]);
  if :: (tells && (known & BIT(b)) && MUTANT != 8) -> ends_up = ends_up | BIT(session[b]) :: else fi;
  if :: is_fault -> failed = failed | BIT(b); if :: MUTANT != 9 -> cool = cool | BIT(b) :: else fi :: else fi;
  at[b] = NONE; session[b] = 0; unnamed = unnamed & ~BIT(b)
}
/* end_unconfirmed: the first one may have overtaken the service_end */
inline unnamed_by_digest(b) {
  if :: ((unnamed & BIT(b)) || MUTANT == 26) -> sr_end(b, 0, 1) :: else -> unnamed = unnamed | BIT(b) fi
}
inline meet(old, new) { /* requester::meet: what is doubted stays so */
  if :: ((doubted & BIT(old)) && (known & BIT(old)) && MUTANT != 25) -> doubted = doubted | BIT(new) :: else fi;
  if :: at[old] == NONE -> known = known & ~BIT(old); offered = offered & ~BIT(old); open_request[old] = 0 :: else fi
}
inline leave_unwanted(k) {
  k = 0;
  do
  :: k < BOOTS -> if :: (at[k] == REMOTE && !(wanted & BIT(k))) -> sr_end(k, 1, 0) :: else fi; k++
  :: else -> break
  od; k = 0
}
inline request(b) {
  if
  :: last_request < REQUESTS ->
     assert(!(failed & BIT(b)) && !(lied & BIT(PROVIDER(b))));
     last_request++; asked[last_request] = b; open_request[b] = last_request;
     offered = offered & ~BIT(b); at[b] = REQUESTED;
     requests[PROVIDER(b)] = requests[PROVIDER(b)] | BIT(last_request)
  :: else -> exhausted = 1
  fi
}
inline choose(o, first, second, stands) { /* the policy, at an offer of `o` */
#if POLICY == ALWAYS
  if :: at[0] == REMOTE -> first = 0 :: at[1] == REMOTE -> first = 1 :: at[2] == REMOTE -> first = 2
     :: else -> first = o fi
#elif POLICY == ANYTHING
  if :: first = o
     :: IN_VIEW(0) -> first = 0 :: IN_VIEW(1) -> first = 1 :: IN_VIEW(2) -> first = 2
     :: skip
     :: IS_REMOTE -> first = HOME fi;
  if :: skip :: (first < HOME && first != 0 && IN_VIEW(0)) -> second = 0
     :: (first < HOME && first != 1 && IN_VIEW(1)) -> second = 1
     :: (first < HOME && first != 2 && IN_VIEW(2)) -> second = 2 fi;
  if :: second < HOME -> if :: stands = second + 1 :: skip fi :: else fi
#elif POLICY == TWO
  if :: (at[0] == REMOTE && !(standing_by == 1 && (at[1] == REMOTE || at[2] == REMOTE))) -> first = 0
     :: (at[1] == REMOTE && !(standing_by == 2 && (at[0] == REMOTE || at[2] == REMOTE))) -> first = 1
     :: (at[2] == REMOTE && !(standing_by == 3 && (at[0] == REMOTE || at[1] == REMOTE))) -> first = 2
     :: else -> first = o fi;
  if :: (first != 0 && IN_VIEW(0)) -> second = 0 :: (first != 1 && IN_VIEW(1)) -> second = 1
     :: (first != 2 && IN_VIEW(2)) -> second = 2 :: else fi;
  stands = ((STANDBY && second < HOME) -> second + 1 : 0)
#else
  if :: (preferred == 1 && IN_VIEW(1)) -> first = 1
     :: (preferred == 0 && IN_VIEW(2)) -> first = 2
     :: (preferred == 0 && IN_VIEW(0)) -> first = 0
     :: else -> if :: at[0] == REMOTE -> first = 0 :: at[1] == REMOTE -> first = 1
                   :: at[2] == REMOTE -> first = 2 :: else -> first = o fi
  fi
#endif
}
inline decide(o, first, second, stands, k) { /* requester::decide */
  first = NOBODY; second = NOBODY; stands = 0;
  if :: IN_VIEW(o) -> choose(o, first, second, stands) :: else fi;
  if
  :: first == HOME ->
     k = 0;
     do :: k < BOOTS -> if :: at[k] == REMOTE -> sr_end(k, 1, 0) :: else fi; k++ :: else -> break od; k = 0
  :: first < HOME ->
     wanted = BIT(first); if :: second < HOME -> wanted = wanted | BIT(second) :: else fi;
     if :: stands != standing_by -> standing_by = stands; to_rm!STANDS_BY(stands) :: else fi;
     if :: (at[first] != NONE && (second == NOBODY || at[second] != NONE)) -> leave_unwanted(k)
        :: else ->
           if :: at[first] == NONE -> request(first) :: else fi;
           if :: second < HOME -> if :: at[second] == NONE -> request(second) :: else fi :: else fi
     fi
  :: else
  fi;
  first = 0; second = 0; stands = 0
}

/* Whether an answer to the open request can still come. */
#define ANSWERS1(b, i) ((acceptances & BIT((b) * MOST + i)) && answers[(b) * MOST + i] == open_request[b])
#if MOST > 5
#define ANSWERS(b) (ANSWERS1(b, 1) || ANSWERS1(b, 2) || ANSWERS1(b, 3) || ANSWERS1(b, 4) || ANSWERS1(b, 5) || ANSWERS1(b, 6))
#elif MOST > 4
#define ANSWERS(b) (ANSWERS1(b, 1) || ANSWERS1(b, 2) || ANSWERS1(b, 3) || ANSWERS1(b, 4) || ANSWERS1(b, 5))
#elif MOST > 3
#define ANSWERS(b) (ANSWERS1(b, 1) || ANSWERS1(b, 2) || ANSWERS1(b, 3) || ANSWERS1(b, 4))
#elif MOST > 2
#define ANSWERS(b) (ANSWERS1(b, 1) || ANSWERS1(b, 2) || ANSWERS1(b, 3))
#else
#define ANSWERS(b) (ANSWERS1(b, 1) || ANSWERS1(b, 2))
#endif
#define ANSWER_COMES(b) ((requests[PROVIDER(b)] & BIT(open_request[b])) || (refusals & BIT(open_request[b])) || ANSWERS(b))
#define REQUEST_TIMEOUT(b) atomic { MUTANT != 19 && open_request[b] != 0 && (left > 0 || !ANSWER_COMES(b)) -> \
     if :: ANSWER_COMES(b) -> FAULT :: else fi; open_request[b] = 0; \
     if :: at[b] == REQUESTED -> at[b] = NONE :: else fi }
#define DATA_COMES(b) (GIVES(session[b]) || ((results | ends_down) & BIT(session[b])) || len(to_rm) != 0 || len(to_sr) != 0)
#define START_TIMEOUT(b) atomic { MUTANT != 18 && at[b] == STARTING && len(to_rm) < 5 && (left > 0 || !DATA_COMES(b)) -> \
     if :: DATA_COMES(b) -> FAULT :: else fi; sr_end(b, 1, 1); CHECK }
/* requester::expire(confirmation_check): neither a result nor a digest comes */
#define WORD_COMES(b) (RUNS(session[b]) || ((results | late_results | digests | ends_down) & BIT(session[b])) || empty_digests != 0 || \
     (told[PROVIDER(b)] != 0 && boot[PROVIDER(b)] == (b)) || len(to_rm) != 0 || len(to_sr) != 0)
#define CONFIRMATION_TIMEOUT(b) atomic { DIGESTS && MUTANT != 11 && at[b] >= STARTING && len(to_rm) < 5 && (left > 0 || !WORD_COMES(b)) -> \
     if :: WORD_COMES(b) -> FAULT :: else fi; sr_end(b, 1, 1); CHECK }

/* Whether a session is above all that it has accepted of that start. */
#define RISES(b, r) (MUTANT == 27 || !(accepted_here & (OF_BOOT0 << ((b) * MOST)) & ~(BIT(r) - 1)))
proctype SR(byte v) {
  byte b, r, first, second, stands, k; mtype m;
end: do
  :: atomic { offers != 0 -> pick(offers, b); arrive(offers, b);
#if CRASH
     if :: (b == 2 && !(known & 4)) -> meet(0, 2) /* it has started again */
        :: (b == 0 && !(known & 1)) -> meet(2, 0)
        :: else fi;
#endif
     known = known | BIT(b); offered = offered | BIT(b);
     if :: (open_request[b] == 0 && !IS_MOVING) -> decide(b, first, second, stands, k) :: else fi;
     b = 0 }
  :: atomic { refusals != 0 -> pick(refusals, k); arrive(refusals, k); b = asked[k];
     if :: ((known & BIT(b)) && open_request[b] == k) -> open_request[b] = 0;
           if :: at[b] == REQUESTED -> at[b] = NONE :: else fi
        :: else fi; b = 0; k = 0 }
  :: atomic { acceptances != 0 -> pick(acceptances, r); arrive(acceptances, r); b = BOOT(r);
     if :: ((known & BIT(b)) && (open_request[b] == answers[r] || MUTANT == 20)) -> open_request[b] = 0;
           if :: (at[b] == REQUESTED && !RISES(b, r)) -> at[b] = NONE /* its counter did not rise */
              :: (at[b] == REQUESTED && RISES(b, r)) ->
                 assert(!(accepted_here & BIT(r))); accepted_here = accepted_here | BIT(r);
                 assert(!(ends_up & BIT(r))); /* what it has ended it does not begin */
                 at[b] = STARTING; session[b] = r; to_rm!AWAIT(r)
              :: else -> if :: (!HAS(r) && (known & BIT(b))) -> ends_up = ends_up | BIT(r) :: else fi
           fi
        :: else -> if :: (!HAS(r) && (known & BIT(b)) && MUTANT != 7) -> ends_up = ends_up | BIT(r) :: else fi
     fi; b = 0; r = 0 }
  :: atomic { results != 0 && len(to_rm) < 5 -> pick(results, r); arrive(results, r);
     if :: HAS(r) -> to_rm!RESULT(r)
        :: else -> if :: (MUTANT != 1 && (known & BIT(BOOT(r)))) -> ends_up = ends_up | BIT(r) :: else fi fi; r = 0 }
  :: atomic { late_results != 0 && len(to_rm) < 5 -> pick(late_results, r); arrive(late_results, r);
     if :: HAS(r) -> to_rm!LATE(r)
        :: else -> if :: (known & BIT(BOOT(r))) -> ends_up = ends_up | BIT(r) :: else fi fi; r = 0 }
#if LIES
  :: atomic { bad_results != 0 && len(to_rm) < 5 -> pick(bad_results, r); arrive(bad_results, r);
     if :: HAS(r) -> to_rm!BAD(r)
        :: else -> if :: (known & BIT(BOOT(r))) -> ends_up = ends_up | BIT(r) :: else fi fi; r = 0 }
#endif
  :: atomic { ends_down != 0 && len(to_rm) < 5 -> pick(ends_down, r); arrive(ends_down, r);
     if :: HAS(r) -> b = BOOT(r); sr_end(b, 0, 1) :: else fi; b = 0; r = 0 }
  /* requester::on_digest: one that names r, and none above it, ... */
  :: atomic { digests != 0 && len(to_rm) < 5 -> pick(digests, r); arrive(digests, r); b = BOOT(r);
     if :: (known & BIT(b)) ->
           if :: (at[b] >= STARTING && (session[b] < r || MUTANT == 10) && session[b] != r) -> unnamed_by_digest(b)
              :: HAS(r) -> unnamed = unnamed & ~BIT(b)
              :: else fi;
           if :: ((open_request[b] == 0 || MUTANT == 12) && !HAS(r)) -> ends_up = ends_up | BIT(r) :: else fi
        :: else fi; b = 0; r = 0 }
  /* ... and one that names none, though r had been accepted */
  :: atomic { empty_digests != 0 && len(to_rm) < 5 -> pick(empty_digests, r); arrive(empty_digests, r); b = BOOT(r);
     if :: ((known & BIT(b)) && at[b] >= STARTING && (session[b] <= r || MUTANT == 10)) ->
           assert(!RUNS(session[b])); /* a late digest ends nothing that runs */
           unnamed_by_digest(b)
        :: else fi; b = 0; r = 0 }
  :: atomic { deaths != 0 && len(to_rm) < 5 -> pick(deaths, k); deaths = deaths & ~BIT(k); /* requester::on_lost */
     if :: k == 1 -> b = 1 :: else -> b = 0 fi;
     if :: at[b] == REQUESTED -> at[b] = NONE :: at[b] >= STARTING -> sr_end(b, 0, 1) :: else fi;
     known = known & ~BIT(b); offered = offered & ~BIT(b); doubted = doubted & ~BIT(b); open_request[b] = 0; k = 0; b = 0 }
  :: atomic { len(to_rm) < 5 && nempty(to_sr) -> to_sr?m, r; b = BOOT(r);
     if
     :: m == FIRST ->
        if :: (HAS(r) && at[b] == STARTING) -> at[b] = REMOTE; leave_unwanted(k) :: else fi
     :: m == VIOLATION -> /* requester::on_violation, leave_beside */
#if CHAIN
        if :: (MUTANT == 35 && HAS(r) && !GETS_INPUTS) -> doubted = doubted | BIT(b) :: else fi;
#endif
        if :: (HAS(r) && MUTANT != 16) ->
              if :: at[b] == REMOTE -> k = 0;
                 do :: k < BOOTS -> if :: (k != b && at[k] == REMOTE) -> sr_end(k, 1, 1) :: else fi; k++
                    :: else -> break od; k = 0
                 :: else fi;
              sr_end(b, 1, 1)
           :: else fi
     :: m == VIOLATION_OF_ONE -> if :: HAS(r) -> sr_end(b, 1, 1) :: else fi
     :: m == IMPLAUSIBLE -> /* requester::distrust_peer_of, whether it runs still or not */
        if :: (MUTANT != 28 && (MUTANT != 29 || HAS(r))) -> doubted = doubted | ((known & BIT(b)) -> known & BOOTS_OF(PROVIDER(b)) : 0) :: else fi;
        lied = lied | BIT(PROVIDER(b));
        if :: HAS(r) -> sr_end(b, 1, 1) :: else fi
     fi; b = 0; r = 0; m = 0; CHECK }
  :: REQUEST_TIMEOUT(0) :: START_TIMEOUT(0) :: CONFIRMATION_TIMEOUT(0)
#if BOOTS > 1
  :: REQUEST_TIMEOUT(1) :: START_TIMEOUT(1) :: CONFIRMATION_TIMEOUT(1)
#endif
#if BOOTS > 2
  :: REQUEST_TIMEOUT(2) :: START_TIMEOUT(2) :: CONFIRMATION_TIMEOUT(2)
#endif
  :: atomic { (cool | failed) != 0 -> cool = 0; failed = 0 }
  od
}

