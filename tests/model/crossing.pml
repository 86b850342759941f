/* Claims of a crossing, as planners/crossing/claim_book makes, hears and binds
 * them: of two that overlap at most one binds, whatever is lost, late or out of
 * order. What docs/model.md explains and tests/acceptance/proof runs.
 *
 * A claim is one of WINDOWS drives through the crossing; those with neighbouring
 * numbers overlap, as do equal ones. A vehicle claims whatever it likes whenever
 * it may, as if servers lied, and gives up at any moment: as it can stop, as what
 * it has claimed is over, or as it does not bind for a second. Any message may be
 * lost; one that was overtaken counts as lost, as claim_book drops it.
 *
 * Of more than two vehicles the others only hold up: they can keep a claim from
 * being made or from binding, and both may happen anyhow. So what holds for two
 * holds for each two of many.
 */
#ifndef VEHICLES
#define VEHICLES 2
#endif
#ifndef WINDOWS
#define WINDOWS 3
#endif
#ifndef CLAIMS
#define CLAIMS 3  /* of a vehicle, one after the other */
#endif
#ifndef ON_AIR
#define ON_AIR 2  /* messages from one vehicle to another that are under way */
#endif
#ifndef SILENCE
#define SILENCE 0 /* 1: a vehicle may not be heard for longer than claim_book::rules::memory */
#endif
#ifndef BINDS
#define BINDS 1   /* 0: that any claim binds is taken for an error, and has to be found */
#endif
#ifndef MUTANT
#define MUTANT 0  /* a rule that is left out */
#endif

#define NO_CLAIM 0
#define PAIR(to, of) ((to) * VEHICLES + (of))
#define OVERLAP(x, y) ((x) != NO_CLAIM && (y) != NO_CLAIM && (x) <= (y) + 1 && (y) <= (x) + 1)

byte own[VEHICLES];  /* what it claims */
bool binds[VEHICLES];
byte made[VEHICLES]; /* its claims so far: a message knows which it was generated after */
byte told[VEHICLES * VEHICLES];        /* the latest that was heard: what it claims, */
byte told_after[VEHICLES * VEHICLES];  /* and after which claim of the hearer it was made */
bool is_silent[VEHICLES * VEHICLES];   /* not heard for longer than memory */
chan air[VEHICLES * VEHICLES] = [ON_AIR] of {byte, byte};

inline give_up() { own[v] = NO_CLAIM; binds[v] = 0 }

inline find_overlap(with, found) { /* claim_book::is_closed */
  found = 0; x = 0;
  do
  :: x < VEHICLES -> if :: (x != v && OVERLAP(with, told[PAIR(v, x)])) -> found = 1 :: else fi; x++
  :: else -> break
  od; x = 0
}

/* claim_book::bind_if_all_consent: a message of each that was generated after the claim */
inline bind_if_all_consent() {
  if
  :: own[v] != NO_CLAIM && !binds[v] ->
     waits = 0; x = 0;
     do
     :: x < VEHICLES ->
        if
        :: (x != v && !is_silent[PAIR(v, x)] && MUTANT != 1 && (MUTANT != 2 || told_after[PAIR(v, x)] == 0) &&
            told_after[PAIR(v, x)] != made[v]) -> waits = 1
        :: else
        fi; x++
     :: else -> break
     od; x = 0;
     if :: !waits -> binds[v] = 1; check() :: else fi; waits = 0
  :: else
  fi
}

/* The promise. */
inline check() {
  assert(BINDS); x = 0;
  do
  :: x < VEHICLES -> assert(x == v || !binds[x] || !OVERLAP(own[v], own[x])); x++
  :: else -> break
  od; x = 0
}

proctype vehicle(byte v) {
  byte x, other, what, after; bool waits, closed;
end: do
  :: atomic { made[v] < CLAIMS -> /* claim_book::claim: in place of the one before, if any */
     select (what : 1 .. WINDOWS);
     find_overlap(what, closed);
     if
     :: (what != own[v] && (!closed || MUTANT == 3)) ->
        own[v] = what; made[v]++;
        if :: MUTANT != 4 -> binds[v] = 0 :: else fi;
        bind_if_all_consent();
        if :: binds[v] -> check() :: else fi
     :: else
     fi; what = 0; closed = 0 }
  :: atomic { own[v] != NO_CLAIM -> give_up() }
  /* it tells everybody, all the time, what it claims */
  :: atomic { select (other : 0 .. VEHICLES - 1);
     if
     :: other != v && len(air[PAIR(other, v)]) < ON_AIR ->
        what = ((MUTANT == 5 && !binds[v]) -> NO_CLAIM : own[v]); after = made[other];
        if :: skip :: MUTANT == 6 -> after++ fi; /* its clock is ahead */
        air[PAIR(other, v)]!what, after
     :: else
     fi; other = 0; what = 0; after = 0 }
  /* claim_book::on_report */
  :: atomic { select (other : 0 .. VEHICLES - 1);
     if
     :: other != v && len(air[PAIR(v, other)]) > 0 ->
        air[PAIR(v, other)]?what, after;
        if
        :: skip /* it was lost */
        :: told[PAIR(v, other)] = what; told_after[PAIR(v, other)] = after; is_silent[PAIR(v, other)] = 0;
           if :: (!binds[v] && OVERLAP(own[v], what) && MUTANT != 7) -> give_up() :: else fi;
           bind_if_all_consent()
        fi
     :: else
     fi; other = 0; what = 0; after = 0 }
#if SILENCE
  :: atomic { select (other : 0 .. VEHICLES - 1);
     if :: (other != v && told[PAIR(v, other)] == NO_CLAIM) -> is_silent[PAIR(v, other)] = 1; bind_if_all_consent() :: else fi;
     other = 0 }
#endif
  od
}

init {
  byte v;
  atomic { do :: v < VEHICLES -> run vehicle(v); v++ :: else -> break od; v = 0 }
}
