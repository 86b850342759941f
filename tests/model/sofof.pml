/* The offloading protocol of offloading/, for one service, one vehicle or two, and
 * one or two providers: what docs/model.md explains and tests/acceptance/proof runs.
 *
 * Three processes are a vehicle's actors: SR (requester), RM (source_selector),
 * WD (watchdog); one for each vehicle and provider is the rest: SP (provider) with
 * the manager and the function of its session. The air is a set of messages, so they
 * arrive in any order; that one is lost, comes twice or too late costs one of `left`
 * faults. There are no clocks: a timer fires for nothing where what it waits for
 * cannot come any more, and costs a fault where it can. Steps that would change
 * nothing are left out, so a run with finitely many faults ends, and `judge` looks at
 * where it ends; assertions look at each step.
 *
 * A session has a number, r: of start `b` of a provider (BOOT), its counter is
 * r - MOST * b. Sets of sessions and of requests are words of bits.
 */

/* -- what a run is given (spin -D) ------------------------------------------- */
#ifndef FAULTS
#define FAULTS 2
#endif
#ifndef VEHICLES
#define VEHICLES 1 /* 2: with one provider that does not die */
#endif
#ifndef PROVIDERS
#define PROVIDERS 1
#endif
#ifndef CHAIN
#define CHAIN 0    /* of VEHICLES: two services of one, the second of which is fed with
                      results of the first. Bits of it: which may be offloaded. */
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
#define REFUSES 0 /* the CODM may refuse, and take back what it has accepted */
#endif
#ifndef SILENT
#define SILENT 0  /* a function may fall silent */
#endif
#ifndef STALE
#define STALE 0   /* a function's input may grow too old, and so all its results */
#endif
#ifndef OFFERS
#define OFFERS 0  /* an offer may come at any moment, also outside of the area */
#endif
#ifndef OUTAGE
#define OUTAGE 0  /* all that is on the air may be lost at once */
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
#define GUARDED 1    /* where nothing of the session is under way, or it is needed */
#define ANY_MOMENT 2 /* also while a request is open, or its answer or an end is under way */
#ifndef DIGESTS
#define DIGESTS GUARDED /* 0: none, as it was once */
#endif
#ifndef TOLD
#define TOLD 2    /* digests after the end of the last session: four, less two lost */
#endif
#ifndef AT_PROVIDER
#define AT_PROVIDER 1 /* 0: only what the vehicle believes is judged at the end */
#endif
#ifndef FALLBACK
#define FALLBACK 0 /* 1: the own function runs after what is called a fallback */
#endif
#ifndef MOST
#define MOST 3    /* sessions of a start: each fault may end one, so FAULTS + 1 */
#endif
#ifndef REQUESTS
#define REQUESTS 6
#endif
#ifndef ENOUGH
#define ENOUGH 1  /* 0: a run may need more sessions or requests than these */
#endif
#ifndef MUTANT
#define MUTANT 0  /* a rule that is left out: tests/acceptance/proof has those that
                     spin finds; docs/model.md has why it does not find the others */
#endif

#if CRASH
#define BOOTS 3
#else
#define BOOTS PROVIDERS
#endif
#define SESSIONS (BOOTS * MOST) /* 14 at most, as REQUESTS: bits of a short */
#define NOBODY 9
#define HOME 8
#define BIT(x) (1 << (x))
#define BOOT(r) (((r) - 1) / MOST)
#define PROVIDER(b) ((b) == 1)
#define BOOTS_OF(p) ((p) == 1 -> 2 : 5)
#define OF_BOOT0 (((1 << MOST) - 1) << 1)
#define ALL_OF(p) ((p) == 1 -> (OF_BOOT0 << MOST) : (OF_BOOT0 | (OF_BOOT0 << (2 * MOST))))

/* -- the state ------------------------------------------------------------------ */
byte left;                  /* faults */
byte boot[2], counter[2];   /* of a provider: its start, sessions of anybody since */
bool alive[2];
bool exhausted;             /* numbers have run out: nobody is offered anything any more */

/* All else there is once for each vehicle, v. */
typedef vehicle {
  /* -- the air */
  byte offers;                /* of boots */
  short refusals;             /* of requests */
  short requests[2];          /* to providers */
  short acceptances, inputs, calls, results_, late_results, bad_results; /* of sessions */
  short ends_up, ends_down;   /* service_end, of sessions */
  short digests;              /* that name this session */
  short empty_digests;        /* that name none; the latest of anybody was this one */
  byte deaths_;               /* of providers: the vehicle's system tells it */
  byte asked[REQUESTS + 1];   /* the boot that a request is for */
  byte answers[SESSIONS + 1]; /* the request that a session answers */
  /* -- SR */
  byte known, offered, cool, doubted, wanted, standing_by, last_request, preferred;
  byte at[3];                 /* the phase at a boot */
  byte session[3];            /* its session there, from acceptance on */
  byte open_request[3];
  byte unnamed;               /* boots: the latest digest did not name the session there */
  short closed_here, accepted_here;
  byte failed, lied;          /* promised: boots that cool down, providers not asked again */
  /* -- RM */
  short sources, in_use_, told_to_stand_by;
  byte standby, watched;
  bool own_runs_, client_remote;
  /* -- WD */
  byte armed;
  /* -- SP: the record of the station, by provider */
  byte seen_request_[2], runs_[2], mute_[2], told[2];
  bool inside_[2], heard[2], fed_[2], called[2], was_inside[2];
  short started, closed_there, died;
};
vehicle V[VEHICLES];
#define offers V[v].offers
#define refusals V[v].refusals
#define requests V[v].requests
#define acceptances V[v].acceptances
#define inputs V[v].inputs
#define calls V[v].calls
#define results V[v].results_
#define late_results V[v].late_results
#define bad_results V[v].bad_results
#define ends_up V[v].ends_up
#define ends_down V[v].ends_down
#define digests V[v].digests
#define empty_digests V[v].empty_digests
#define deaths V[v].deaths_
#define asked V[v].asked
#define answers V[v].answers
#define known V[v].known
#define offered V[v].offered
#define cool V[v].cool
#define doubted V[v].doubted
#define wanted V[v].wanted
#define standing_by V[v].standing_by
#define last_request V[v].last_request
#define preferred V[v].preferred
#define at V[v].at
#define session V[v].session
#define open_request V[v].open_request
#define unnamed V[v].unnamed
#define closed_here V[v].closed_here
#define accepted_here V[v].accepted_here
#define failed V[v].failed
#define lied V[v].lied
#define sources V[v].sources
#define in_use V[v].in_use_
#define told_to_stand_by V[v].told_to_stand_by
#define standby V[v].standby
#define watched V[v].watched
#define own_runs V[v].own_runs_
#define client_remote V[v].client_remote
#define armed V[v].armed
#define seen_request V[v].seen_request_
#define runs V[v].runs_
#define mute V[v].mute_
#define told V[v].told
#define inside V[v].inside_
#define heard V[v].heard
#define fed V[v].fed_
#define called V[v].called
#define was_inside V[v].was_inside
#define started V[v].started
#define closed_there V[v].closed_there
#define died V[v].died

mtype = {AWAIT, RESULT, LATE, BAD, END, STANDS_BY, FIRST, VIOLATION, VIOLATION_OF_ONE,
         IMPLAUSIBLE, ARM, DISARM};
chan rm_mail[VEHICLES] = [10] of {mtype, byte};
chan sr_mail[VEHICLES] = [8] of {mtype, byte};
chan wd_mail[VEHICLES] = [8] of {mtype, byte};
#define to_rm rm_mail[v]
#define to_sr sr_mail[v]
#define to_wd wd_mail[v]

/* phases of a session */
#define NONE 0
#define REQUESTED 1
#define STARTING 2
#define REMOTE 3
#define OLD 2 /* of a function: mute as its input is too old */

#define HAS(r) (session[BOOT(r)] == (r) && at[BOOT(r)] >= STARTING)
#define MOVES(b) (at[b] == REQUESTED || at[b] == STARTING)
#define IS_MOVING (MOVES(0) || MOVES(1) || MOVES(2))
#define IS_REMOTE (at[0] == REMOTE || at[1] == REMOTE || at[2] == REMOTE)
#define STANDS(r) (standby == BOOT(r) + 1 && (in_use & ~BIT(r)))
#define RUNS(r) (alive[PROVIDER(BOOT(r))] && runs[PROVIDER(BOOT(r))] == (r))
#define GIVES(r) (RUNS(r) && !mute[PROVIDER(BOOT(r))] && GETS_INPUTS)
#define MAY_ASK(b) ((known & BIT(b)) && (offered & BIT(b)) && !((cool | doubted) & BIT(b)) && open_request[b] == 0 && at[b] == NONE)
#define IN_VIEW(b) ((b) < BOOTS && (at[b] != NONE || MAY_ASK(b)))
#define FAULT left--
/* A chain: chain_stage.cpp makes inputs of the second service of results of the first,
 * whoever gives them. What is asked anew has waited for a cool-down, and by then a first
 * one that had fallen silent has come home. */
#if CHAIN
#define MAY_OFFLOAD ((CHAIN & BIT(v)) != 0)
#define FIRST_GOES_ON(p) (alive[p] && !V[0].mute_[p] && V[0].runs_[p] != 0 && V[0].fed_[p] && (V[0].in_use_ & BIT(V[0].runs_[p])))
#define FIRST_GIVES ((MUTANT != 30 && V[0].own_runs_) || \
     (MUTANT != 31 && ((V[0].results_ & V[0].in_use_) || FIRST_GOES_ON(0) || FIRST_GOES_ON(1))))
#define GETS_INPUTS (v == 0 || FIRST_GIVES)
#define MAY_COME_HOME ((MUTANT != 33 || v == 1 || V[1].in_use_ == 0) && \
     ((MUTANT != 33 && MUTANT != 34) || v == 0 || FIRST_GIVES))
#define OTHER V[1 - v]
#else
#define MAY_OFFLOAD 1
#define GETS_INPUTS 1
#define MAY_COME_HOME 1
#endif

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

#include "requester.pml"
#include "selector.pml"
#include "provider.pml"
#include "faults.pml"

init {
  byte v;
  atomic {
    left = FAULTS;
    do :: left > 0 -> left-- :: break od; /* any number up to FAULTS */
    boot[1] = 1; alive[0] = 1; alive[1] = PROVIDERS > 1;
    do
    :: v < VEHICLES ->
       own_runs = 1; inside[0] = 1; inside[1] = PROVIDERS > 1;
       run SR(v); run RM(v); run WD(v); run faults(v); run SP(0, v);
       if :: PROVIDERS > 1 -> run SP(1, v) :: else fi; v++
    :: else -> break
    od; v = 0
  }
}

/* == promises at the end ================================================================ */
#define SET_OF(r) ((r) != 0 -> BIT(r) : 0)
#define HELPS(p) (alive[p] && inside[p] && !(lied & BIT(p)))
active proctype judge() {
  byte b, v;
end: do
  :: timeout ->
     assert(!exhausted || !ENOUGH);
     v = 0;
     do
     :: v < VEHICLES ->
        assert(len(to_rm) == 0 && len(to_sr) == 0 && len(to_wd) == 0);
        b = 0;
        do :: b < BOOTS ->
              assert((at[b] == REMOTE) == (session[b] != 0 && (in_use & BIT(session[b])) != 0));
              assert(at[b] == NONE || at[b] == REMOTE);
              assert(at[b] == NONE || RUNS(session[b])); /* what the vehicle believes runs there */
              b++
           :: else -> break od; b = 0;
        /* what was begun and not closed is what runs, on both sides */
        assert((started & ~(closed_there | died)) == (SET_OF(runs[0]) | SET_OF(runs[1])));
        assert((accepted_here & ~closed_here) == (SET_OF(session[0]) | SET_OF(session[1]) | SET_OF(session[2])));
        assert((in_use != 0) == client_remote && client_remote == !own_runs);
        assert((armed != 0) == (in_use != 0));
        assert(in_use == 0 || GOES_ON); /* what is used gives results */
#if CHAIN
        assert(GETS_INPUTS); /* so does what is at home */
#endif
#if AT_PROVIDER
        /* what runs there the vehicle has */
        assert(!alive[0] || runs[0] == 0 || HAS(runs[0]));
        assert(!alive[1] || runs[1] == 0 || HAS(runs[1]));
#endif
#if POLICY != ANYTHING
        assert(in_use != 0 || !(HELPS(0) || HELPS(1)) || !MAY_OFFLOAD || exhausted); /* it offloads where it can */
#endif
        v++
     :: else -> break
     od; break
  od
}
