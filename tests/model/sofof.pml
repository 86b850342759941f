/* The offloading protocol of offloading/, for one vehicle, one service, and one or
 * two providers: what docs/model.md explains and tests/acceptance/proof runs.
 *
 * Three processes are the vehicle's actors: SR (requester), RM (source_selector),
 * WD (watchdog); one for each provider is the rest: SP (provider) with the manager
 * and the function of its session. The air is a set of messages, so they arrive in
 * any order; that one is lost, comes twice or too late costs one of `left` faults.
 * There are no clocks: a timer fires for nothing where what it waits for cannot
 * come any more, and costs a fault where it can. Steps that would change nothing
 * are left out, so a run with finitely many faults ends, and `judge` looks at where
 * it ends; assertions look at each step.
 *
 * A session has a number, r: of start `b` of a provider (BOOT), its counter is
 * r - MOST * b. Sets of sessions and of requests are words of bits.
 */

/* -- what a run is given (spin -D) ------------------------------------------- */
#ifndef FAULTS
#define FAULTS 2
#endif
#ifndef PROVIDERS
#define PROVIDERS 1
#endif
#define ALWAYS 0   /* where it runs, else whoever offers */
#define ANYTHING 1 /* any provider, two, a standby, home: as a policy may decide */
#define TWO 2      /* two at once; the second stands by if STANDBY */
#define HANDOVER 3 /* the provider that is preferred, which may change */
#ifndef POLICY
#define POLICY ALWAYS
#endif
#ifndef STANDBY
#define STANDBY 0
#endif
#ifndef LEAVES
#define LEAVES 0  /* the vehicle leaves the first area, and comes back */
#endif
#ifndef REFUSES
#define REFUSES 0 /* the CODM may refuse */
#endif
#ifndef SILENT
#define SILENT 0  /* a function may fall silent */
#endif
#ifndef LIES
#define LIES 0    /* a result may be implausible */
#endif
#ifndef NEIGHBOUR
#define NEIGHBOUR 0 /* another vehicle has sessions at the first provider */
#endif
#ifndef CRASH
#define CRASH 0   /* the first provider dies once and starts again; 1: beside the
                     vehicle, which is told; 2: over a connection, whose end ends
                     what ran and what was under way */
#endif
#ifndef DIGESTS
#define DIGESTS 1 /* 0: as it was before there were any */
#endif
#ifndef MOST
#define MOST 3    /* sessions of a start */
#endif
#ifndef REQUESTS
#define REQUESTS 6
#endif
#ifndef MUTANT
#define MUTANT 0  /* a rule that is left out: tests/acceptance/proof has those that
                     spin finds; docs/model.md has why it does not find 2, 4, 6 to
                     9, 11, 12 and 22 */
#endif

#if CRASH
#define BOOTS 3
#else
#define BOOTS PROVIDERS
#endif
#define SESSIONS (3 * MOST)
#define NOBODY 9
#define HOME 8
#define BIT(x) (1 << (x))
#define BOOT(r) (((r) - 1) / MOST)
#define PROVIDER(b) ((b) == 1)
#define OF_BOOT0 (((1 << MOST) - 1) << 1)
#define ALL_OF(p) ((p) == 1 -> (OF_BOOT0 << MOST) : (OF_BOOT0 | (OF_BOOT0 << (2 * MOST))))

/* -- the air ------------------------------------------------------------------ */
byte left;
byte offers;                /* of boots */
short refusals;             /* of requests */
short requests[2];          /* to providers */
short acceptances, inputs, calls, results, late_results, bad_results; /* of sessions */
short ends_up, ends_down;   /* service_end, of sessions */
short digests;              /* that name this session, the latest one */
short empty_digests;        /* that name none; the latest was this one */
byte deaths;                /* of providers: the vehicle's system tells it */
byte asked[REQUESTS + 1];   /* the boot that a request is for */
byte answers[SESSIONS + 1]; /* the request that a session answers */

/* -- SR ------------------------------------------------------------------------ */
#define NONE 0
#define REQUESTED 1
#define STARTING 2
#define REMOTE 3
byte known, offered, cool, wanted, standing_by, last_request, preferred;
byte at[3];            /* the phase at a boot */
byte session[3];       /* its session there, from acceptance on */
byte open_request[3];
byte unnamed;          /* boots: the latest digest did not name the session there */
short closed_here, accepted_here;
/* -- RM ------------------------------------------------------------------------ */
short sources, in_use, told_to_stand_by;
byte standby, watched;
bool own_runs = 1, client_remote;
/* -- WD ------------------------------------------------------------------------ */
byte armed;
/* -- SP ------------------------------------------------------------------------ */
byte boot[2], seen_request[2], runs[2], counter[2];
bool alive[2], inside[2], heard[2], fed[2], called[2], mute[2];
short started, closed_there, died;
bool exhausted;        /* numbers have run out: such a run tells nothing at its end */

mtype = {AWAIT, RESULT, LATE, BAD, END, STANDS_BY, FIRST, VIOLATION, VIOLATION_OF_ONE,
         ARM, DISARM};
chan to_rm = [10] of {mtype, byte};
chan to_sr = [8] of {mtype, byte};
chan to_wd = [8] of {mtype, byte};

#define HAS(r) (session[BOOT(r)] == (r) && at[BOOT(r)] >= STARTING)
#define MOVES(b) (at[b] == REQUESTED || at[b] == STARTING)
#define IS_MOVING (MOVES(0) || MOVES(1) || MOVES(2))
#define IS_REMOTE (at[0] == REMOTE || at[1] == REMOTE || at[2] == REMOTE)
#define STANDS(r) (standby == BOOT(r) + 1 && (in_use & ~BIT(r)))
#define RUNS(r) (alive[PROVIDER(BOOT(r))] && runs[PROVIDER(BOOT(r))] == (r))
#define GIVES(r) (RUNS(r) && !mute[PROVIDER(BOOT(r))])
#define MAY_ASK(b) ((known & BIT(b)) && (offered & BIT(b)) && !(cool & BIT(b)) && open_request[b] == 0 && at[b] == NONE)
#define IN_VIEW(b) (at[b] != NONE || MAY_ASK(b))
#define FAULT left--

inline pick(set, x) { /* any member */
  x = 0;
  do
  :: (set & BIT(x)) -> break
  :: (set >> (x + 1)) -> x++
  od
}
inline arrive(set, x) { /* a copy may come again */
  if :: set = set & ~BIT(x) :: left > 0 -> FAULT fi
}

/* -- promises at every step ------------------------------------------------------ */
/* While results of providers are used, something watches them, or ends them. */
#define IS_WATCHED (in_use == 0 || armed != 0 || to_wd??[ARM, eval(watched)] || \
                    to_sr??[VIOLATION, eval(watched)] || to_rm??[END, eval(watched)])
#define CHECK assert(own_runs == !client_remote && client_remote == (in_use != 0) && IS_WATCHED)

/* == SR: requester.cpp, requester_sessions.cpp ==================================== */
inline sr_end(b, tells, is_fault) { /* requester::end */
  assert(at[b] >= STARTING && session[b] != 0);
  assert(!(closed_here & BIT(session[b])));
  closed_here = closed_here | BIT(session[b]);
  to_rm!END(session[b]);
  if :: (tells && (known & BIT(b)) && MUTANT != 8) -> ends_up = ends_up | BIT(session[b]) :: else fi;
  if :: (is_fault && MUTANT != 9) -> cool = cool | BIT(b) :: else fi;
  at[b] = NONE; session[b] = 0; unnamed = unnamed & ~BIT(b)
}
/* end_unconfirmed: the first one may have overtaken the service_end */
inline unnamed_by_digest(b) {
  if :: (unnamed & BIT(b)) -> sr_end(b, 0, 1) :: else -> unnamed = unnamed | BIT(b) fi
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
#if MOST > 3
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
/* requester::expire(confirmation_check): neither a result nor a digest can come */
#define WORD_COMES(b) (RUNS(session[b]) || ((results | digests | empty_digests | ends_down) & BIT(session[b])) || len(to_rm) != 0 || len(to_sr) != 0)
#define CONFIRMATION_TIMEOUT(b) atomic { DIGESTS && MUTANT != 11 && at[b] >= STARTING && len(to_rm) < 5 && !WORD_COMES(b) -> \
     sr_end(b, 1, 1); CHECK }

active proctype SR() {
  byte b, r, first, second, stands, k; mtype m;
end: do
  :: atomic { offers != 0 -> pick(offers, b); arrive(offers, b);
     if :: (b == 2 && !(known & 4)) -> /* it has started again: requester::meet */
           if :: at[0] == NONE -> known = known & ~1; offered = offered & ~1; open_request[0] = 0 :: else fi
        :: (b == 0 && !(known & 1)) ->
           if :: at[2] == NONE -> known = known & ~4; offered = offered & ~4; open_request[2] = 0 :: else fi
        :: else fi;
     known = known | BIT(b); offered = offered | BIT(b);
     if :: (open_request[b] == 0 && !IS_MOVING) -> decide(b, first, second, stands, k) :: else fi;
     b = 0 }
  :: atomic { refusals != 0 -> pick(refusals, k); arrive(refusals, k); b = asked[k];
     if :: ((known & BIT(b)) && open_request[b] == k) -> open_request[b] = 0;
           if :: at[b] == REQUESTED -> at[b] = NONE :: else fi
        :: else fi; b = 0; k = 0 }
  :: atomic { acceptances != 0 -> pick(acceptances, r); arrive(acceptances, r); b = BOOT(r);
     if :: ((known & BIT(b)) && (open_request[b] == answers[r] || MUTANT == 20)) -> open_request[b] = 0;
           if :: at[b] == REQUESTED ->
                 assert(!(accepted_here & BIT(r))); accepted_here = accepted_here | BIT(r);
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
     if :: HAS(r) -> to_rm!BAD(r) :: else fi; r = 0 }
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
     known = known & ~BIT(b); offered = offered & ~BIT(b); open_request[b] = 0; k = 0; b = 0 }
  :: atomic { len(to_rm) < 5 && nempty(to_sr) -> to_sr?m, r; b = BOOT(r);
     if
     :: m == FIRST ->
        if :: (HAS(r) && at[b] == STARTING) -> at[b] = REMOTE; leave_unwanted(k) :: else fi
     :: m == VIOLATION -> /* requester::on_violation, leave_beside */
        if :: (HAS(r) && MUTANT != 16) ->
              if :: at[b] == REMOTE -> k = 0;
                 do :: k < BOOTS -> if :: (k != b && at[k] == REMOTE) -> sr_end(k, 1, 1) :: else fi; k++
                    :: else -> break od; k = 0
                 :: else fi;
              sr_end(b, 1, 1)
           :: else fi
     :: m == VIOLATION_OF_ONE -> if :: HAS(r) -> sr_end(b, 1, 1) :: else fi
     fi; b = 0; r = 0; m = 0; CHECK }
  :: REQUEST_TIMEOUT(0) :: REQUEST_TIMEOUT(1) :: REQUEST_TIMEOUT(2)
  :: START_TIMEOUT(0) :: START_TIMEOUT(1) :: START_TIMEOUT(2)
  :: CONFIRMATION_TIMEOUT(0) :: CONFIRMATION_TIMEOUT(1) :: CONFIRMATION_TIMEOUT(2)
  :: atomic { cool != 0 -> cool = 0 }
  od
}

/* == RM: source_selector.cpp ======================================================= */
inline feed(r) {
  if :: STANDS(r) -> calls = calls | BIT(r); told_to_stand_by = told_to_stand_by | BIT(r)
     :: else -> inputs = inputs | BIT(r); told_to_stand_by = told_to_stand_by & ~BIT(r) fi
}
inline tell_roles(k) { /* announce_roles */
  k = 1;
  do :: k <= SESSIONS ->
        if :: ((in_use & BIT(k)) && (((told_to_stand_by & BIT(k)) != 0) != (STANDS(k) != 0))) -> feed(k) :: else fi; k++
     :: else -> break od; k = 0
}
inline rm_end(r, k) { /* on_end */
  if :: (sources & BIT(r)) ->
     sources = sources & ~BIT(r);
     told_to_stand_by = told_to_stand_by & ~BIT(r);
     if :: (in_use & BIT(r)) -> in_use = in_use & ~BIT(r);
           if :: in_use == 0 -> if :: MUTANT != 4 -> to_wd!DISARM(r) :: else fi;
                 assert(!own_runs && client_remote);
                 own_runs = (MUTANT != 15); client_remote = (MUTANT == 23)
              :: else -> tell_roles(k);
                 if :: (watched == r && MUTANT != 3) -> k = 1;
                       do :: ((in_use & BIT(k)) && !STANDS(k)) -> break
                          :: (in_use >> (k + 1)) -> k++ od;
                       watched = k; to_wd!ARM(k); k = 0
                    :: else fi
           fi
        :: else fi
     :: else fi
}
#define IS_SILENT(b) (!GIVES(session[b]) && !STANDS(session[b]) && !(results & BIT(session[b])))
/* give_up_silent */
#define GIVE_UP(b) atomic { session[b] != 0 && at[b] == REMOTE && (in_use & BIT(session[b])) && (in_use & ~BIT(session[b])) && \
     len(to_rm) == 0 && len(to_sr) == 0 && (IS_SILENT(b) || left > 0) -> \
     if :: !IS_SILENT(b) -> FAULT :: else fi; to_sr!VIOLATION_OF_ONE(session[b]) }
active proctype RM() {
  byte r, k; mtype m;
end: do
  :: atomic { len(to_sr) < 6 && len(to_wd) < 6 && nempty(to_rm) -> to_rm?m, r;
     if
     :: m == AWAIT -> sources = sources | BIT(r); feed(r)
     :: m == RESULT ->
        if :: ((sources & BIT(r)) || MUTANT == 22) ->
           if :: !(in_use & BIT(r)) -> /* begin */
                 if :: in_use == 0 -> assert(own_runs && !client_remote);
                       own_runs = 0; watched = r; client_remote = 1;
                       if :: MUTANT != 17 -> to_wd!ARM(r) :: else fi
                    :: else fi;
                 in_use = in_use | BIT(r); to_sr!FIRST(r); tell_roles(k)
              :: else -> if :: (STANDS(r) && !called[PROVIDER(BOOT(r))]) -> feed(r) :: else fi
           fi;
           assert(client_remote && !own_runs) /* used */
        :: else fi
     :: m == LATE -> if :: (in_use == BIT(r)) -> to_wd!LATE(watched) :: else fi
     :: m == BAD -> if :: (sources & BIT(r)) -> rm_end(r, k); to_sr!VIOLATION_OF_ONE(r) :: else fi
     :: m == END -> if :: MUTANT != 24 -> rm_end(r, k) :: else fi
     :: m == STANDS_BY -> standby = r; tell_roles(k)
     fi; m = 0; r = 0; CHECK }
  :: GIVE_UP(0) :: GIVE_UP(1) :: GIVE_UP(2)
  /* a cycle was not answered in time: the standby is called */
  :: atomic { left > 0 && standby != 0 && session[standby - 1] != 0 && (in_use & BIT(session[standby - 1])) && STANDS(session[standby - 1]) ->
     FAULT; feed(session[standby - 1]) }
  od
}

/* == WD: watchdog.cpp ============================================================== */
#define GOES_ON1(p) (alive[p] && !mute[p] && runs[p] != 0 && fed[p] && (in_use & BIT(runs[p])))
#define GOES_ON ((results & in_use) || GOES_ON1(0) || GOES_ON1(1))
active proctype WD() {
  byte r; mtype m;
end: do
  :: atomic { len(to_sr) < 6 && nempty(to_wd) -> to_wd?m, r;
     if :: m == ARM -> armed = r
        :: m == LATE -> if :: (armed == r && r != 0) -> to_sr!VIOLATION(r); armed = 0 :: else fi
        :: m == DISARM -> if :: armed == r -> armed = 0 :: else fi
     fi; m = 0; r = 0; CHECK }
  :: atomic { MUTANT != 13 && len(to_sr) < 6 && armed != 0 && len(to_wd) == 0 && (left > 0 || (!GOES_ON && len(to_rm) == 0 && len(to_sr) == 0)) ->
     if :: (GOES_ON || len(to_rm) != 0 || len(to_sr) != 0) -> FAULT :: else fi; to_sr!VIOLATION(armed); armed = 0; CHECK }
  od
}

/* == SP: provider.cpp, provider_requests.cpp; provider_manager.cpp, service_cycle.cpp */
inline sp_end(p, tells) {
  if :: runs[p] != 0 ->
        assert(!(closed_there & BIT(runs[p])));
        closed_there = closed_there | BIT(runs[p]);
        if :: tells -> ends_down = ends_down | BIT(runs[p]) :: else fi;
        runs[p] = 0; fed[p] = 0; called[p] = 0; mute[p] = 0
     :: else fi
}
#define LATEST(p) (boot[p] * MOST + counter[p])
#define HAS_OPEN(p) (open_request[boot[p]] != 0)
/* Whether input of its session is, or comes, on the way. */
#define IS_FED(p) (len(to_rm) != 0 || (sources & BIT(runs[p])) || ((inputs | calls | acceptances) & BIT(runs[p])))
proctype SP(byte p) {
  byte r, n; short w;
end: do
  :: atomic { alive[p] && !heard[p] -> heard[p] = 1; seen_request[p] = 0 } /* a CAM */
  /* an offer that SR would act on */
  :: atomic { alive[p] && inside[p] && heard[p] && runs[p] == 0 && !(offers & BIT(boot[p])) && at[boot[p]] == NONE &&
              !HAS_OPEN(p) && !IS_MOVING && !(cool & BIT(boot[p])) && !(POLICY == ALWAYS && IS_REMOTE) &&
              (refusals | requests[0] | requests[1] | ends_up | ends_down) == 0 && len(to_rm) == 0 && len(to_sr) == 0 && !exhausted &&
              (POLICY != HANDOVER || !IS_REMOTE || preferred == p) && (POLICY != ANYTHING || !(offered & BIT(boot[p])) || left > 0) ->
#if POLICY == ANYTHING
     if :: (offered & BIT(boot[p])) -> FAULT :: else fi;
#endif
     offers = offers | BIT(boot[p]) }
  :: atomic { requests[p] != 0 -> pick(requests[p], n); arrive(requests[p], n);
     if
     :: !alive[p]
     :: (alive[p] && (asked[n] != boot[p] || !heard[p])) -> refusals = refusals | BIT(n)
     :: (alive[p] && asked[n] == boot[p] && heard[p] && (n > seen_request[p] || MUTANT == 6)) ->
        seen_request[p] = n;
        if :: MUTANT != 5 -> sp_end(p, 1) :: else fi;
        if :: (inside[p] && counter[p] < MOST) ->
              counter[p]++; r = LATEST(p); answers[r] = n; runs[p] = r;
              started = started | BIT(r); acceptances = acceptances | BIT(r)
           :: !inside[p] -> refusals = refusals | BIT(n)
           :: (REFUSES && left > 0) -> FAULT; refusals = refusals | BIT(n)
           :: counter[p] >= MOST -> exhausted = 1; refusals = refusals | BIT(n)
        fi
     :: else
     fi; n = 0; r = 0 }
  :: atomic { (ends_up & ALL_OF(p)) != 0 -> w = ends_up & ALL_OF(p); pick(w, r); w = 0; arrive(ends_up, r);
     if :: (alive[p] && runs[p] == r) -> sp_end(p, 0) :: else fi; r = 0 }
  /* RM feeds it, as far as that changes anything */
  :: atomic { runs[p] != 0 && alive[p] && (sources & BIT(runs[p])) && !((inputs | calls) & BIT(runs[p])) && !((in_use & BIT(runs[p])) && STANDS(runs[p])) &&
       ((!STANDS(runs[p]) && (!fed[p] || called[p])) || (STANDS(runs[p]) && !(results & BIT(runs[p])) && len(to_rm) == 0)) -> feed(runs[p]) }
  :: atomic { (inputs & ALL_OF(p)) != 0 -> w = inputs & ALL_OF(p); pick(w, r); w = 0; arrive(inputs, r);
     if :: (alive[p] && runs[p] == r) -> fed[p] = 1; called[p] = 0 :: else fi; r = 0 }
  :: atomic { (calls & ALL_OF(p)) != 0 -> w = calls & ALL_OF(p); pick(w, r); w = 0; arrive(calls, r);
     if :: (alive[p] && runs[p] == r) -> fed[p] = 1; called[p] = 1; results = (mute[p] -> results : results | BIT(r)) :: else fi; r = 0 }
  /* a result in every period, unless it stands by; where it changes anything */
  :: atomic { alive[p] && runs[p] != 0 && fed[p] && !called[p] && !mute[p] && !(results & BIT(runs[p])) && len(to_rm) < 3 &&
      ((!HAS(runs[p]) && (known & BIT(BOOT(runs[p]))) && !(ends_up & BIT(runs[p])) && !(acceptances & BIT(runs[p]))) ||
        (HAS(runs[p]) && (sources & BIT(runs[p])) && !(in_use & BIT(runs[p])) && !(to_rm??[RESULT, eval(runs[p])])) ||
        (HAS(runs[p]) && (in_use & BIT(runs[p])) && STANDS(runs[p]) && !(calls & BIT(runs[p])) && !(to_rm??[RESULT, eval(runs[p])]))) ->
     results = results | BIT(runs[p]) }
  :: atomic { left > 0 && alive[p] && runs[p] != 0 && fed[p] && !called[p] -> FAULT; late_results = late_results | BIT(runs[p]) }
#if LIES
  :: atomic { left > 0 && alive[p] && runs[p] != 0 && fed[p] -> FAULT; bad_results = bad_results | BIT(runs[p]) }
#endif
  /* never fed: protocol::start_timeout */
  :: atomic { alive[p] && runs[p] != 0 && !fed[p] && MUTANT != 2 && (left > 0 || !IS_FED(p)) ->
     if :: IS_FED(p) -> FAULT :: else fi; sp_end(p, 1) }
#if DIGESTS
  /* a digest, where it changes anything; after the end of the last session there are four */
  :: atomic { alive[p] && heard[p] && runs[p] != 0 && runs[p] == LATEST(p) && (known & BIT(boot[p])) && !(digests & BIT(runs[p])) &&
       ((!HAS(runs[p]) && !HAS_OPEN(p) && !((ends_up | acceptances) & BIT(runs[p])))
        || (at[boot[p]] >= STARTING && session[boot[p]] < runs[p] && len(to_rm) == 0)) && MUTANT != 14 ->
     digests = digests | BIT(runs[p]) }
  :: atomic { alive[p] && heard[p] && runs[p] == 0 && counter[p] != 0 && at[boot[p]] >= STARTING && session[boot[p]] <= LATEST(p) &&
       !(acceptances & BIT(LATEST(p))) && !(empty_digests & BIT(LATEST(p))) && !(ends_down & BIT(session[boot[p]])) && len(to_rm) == 0 && len(to_sr) == 0 ->
     empty_digests = empty_digests | BIT(LATEST(p)) }
#endif
  :: atomic { alive[p] && heard[p] && !inside[p] && runs[p] != 0 -> sp_end(p, 1) } /* left_area */
  :: atomic { left > 0 && alive[p] && heard[p] -> FAULT;
     if :: MUTANT != 21 -> sp_end(p, 1) :: else -> runs[p] = 0; fed[p] = 0 fi; heard[p] = 0 } /* cam_timeout */
  od
}

/* == faults =========================================================================== */
inline lose(set, x) { pick(set, x); set = set & ~BIT(x); FAULT; x = 0 }
active proctype faults() {
  byte x;
  atomic {
    left = FAULTS;
    do :: left > 0 -> left-- :: break od; /* any number up to FAULTS */
    boot[1] = 1; alive[0] = 1; inside[0] = 1; alive[1] = PROVIDERS > 1; inside[1] = PROVIDERS > 1;
    run SP(0); if :: PROVIDERS > 1 -> run SP(1) :: else fi
  }
end: do
  :: atomic { left > 0 && offers != 0 -> lose(offers, x) }
  :: atomic { left > 0 && requests[0] != 0 -> lose(requests[0], x) }
  :: atomic { left > 0 && requests[1] != 0 -> lose(requests[1], x) }
  :: atomic { left > 0 && refusals != 0 -> lose(refusals, x) }
  :: atomic { left > 0 && acceptances != 0 -> lose(acceptances, x) }
  :: atomic { left > 0 && inputs != 0 -> lose(inputs, x) }
  :: atomic { left > 0 && calls != 0 -> lose(calls, x) }
  :: atomic { left > 0 && results != 0 -> lose(results, x) }
  :: atomic { left > 0 && ends_up != 0 -> lose(ends_up, x) }
  :: atomic { left > 0 && ends_down != 0 -> lose(ends_down, x) }
  :: atomic { left > 0 && digests != 0 -> lose(digests, x) }
  :: atomic { left > 0 && empty_digests != 0 -> lose(empty_digests, x) }
#if SILENT
  :: atomic { left > 0 && alive[0] && runs[0] != 0 && !mute[0] -> FAULT; mute[0] = 1 }
#endif
#if POLICY == HANDOVER
  :: atomic { left > 0 -> FAULT; preferred = 1 - preferred }
#endif
#if LEAVES
  :: atomic { left > 0 -> FAULT; inside[0] = 1 - inside[0] }
#endif
#if NEIGHBOUR
  :: atomic { left > 0 && alive[0] && runs[0] == 0 && counter[0] < MOST - 1 -> FAULT; counter[0]++ }
#endif
#if CRASH
  :: atomic { left > 0 && alive[0] && boot[0] == 0 -> FAULT;
     alive[0] = 0; heard[0] = 0; died = died | BIT(runs[0]); runs[0] = 0; fed[0] = 0; called[0] = 0;
     x = 1; do :: x <= SESSIONS -> if :: PROVIDER(BOOT(x)) == 0 ->
        acceptances = acceptances & ~BIT(x); results = results & ~BIT(x); late_results = late_results & ~BIT(x);
        bad_results = bad_results & ~BIT(x); inputs = inputs & ~BIT(x); calls = calls & ~BIT(x);
        digests = digests & ~BIT(x); empty_digests = empty_digests & ~BIT(x) :: else fi; x++ :: else -> break od; x = 0;
     offers = offers & ~1;
#if CRASH == 2
     if :: session[0] != 0 -> ends_down = ends_down | BIT(session[0]) :: else fi
#else
     deaths = deaths | 1
#endif
     }
  :: atomic { !alive[0] && deaths == 0 -> alive[0] = 1; boot[0] = 2; counter[0] = 0; seen_request[0] = 0 }
#endif
  od
}

/* == promises at the end ================================================================ */
#define SET_OF(r) ((r) != 0 -> BIT(r) : 0)
active proctype judge() {
  byte b;
end: do
  :: timeout ->
     assert(len(to_rm) == 0 && len(to_sr) == 0 && len(to_wd) == 0);
     if :: !exhausted ->
        b = 0;
        do :: b < BOOTS ->
              assert((at[b] == REMOTE) == (session[b] != 0 && (in_use & BIT(session[b])) != 0));
              assert(at[b] == NONE || at[b] == REMOTE);
              assert(at[b] == NONE || RUNS(session[b])); /* what the vehicle believes runs there */
              b++
           :: else -> break od;
        /* what was begun and not closed is what runs, on both sides */
        assert((started & ~(closed_there | died)) == (SET_OF(runs[0]) | SET_OF(runs[1])));
        assert((accepted_here & ~closed_here) == (SET_OF(session[0]) | SET_OF(session[1]) | SET_OF(session[2])));
        assert((in_use != 0) == client_remote && client_remote == !own_runs);
        assert((armed != 0) == (in_use != 0));
        assert(in_use == 0 || GOES_ON); /* what is used gives results */
        /* what runs there the vehicle has */
        assert(!alive[0] || runs[0] == 0 || HAS(runs[0]));
        assert(!alive[1] || runs[1] == 0 || HAS(runs[1]));
#if POLICY != ANYTHING
        assert(in_use != 0 || !((alive[0] && inside[0]) || (alive[1] && inside[1]))); /* it offloads where it can */
#endif
        skip
     :: else
     fi; break
  od
}
