// Cars at four arms that a conductor tells how to drive: delays, touches. Built
// with planners/crossing and the libraries; EACH cars on R ways, SEEDS EVERY.
#include <cstdlib>
#include "planners/crossing/conductor.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/toy_streets.hpp"
#include <cstdio>
#include <ctime>
#include <algorithm>
using namespace sofof; using namespace sofof::planners;
static planned_path centre(const reference_line& line, double s){ planned_path p; p.start_s_m=s; p.ds_m=1; p.size=170; for(int k=0;k<p.size;++k) p.knots[k].x={0,0,line.curvature_1pm(s+k)}; p.measure([&](double x){return line.curvature_1pm(x);}); return p; }
struct car { station_id who; route_profile_ptr way; double s=0,v=0,a=0; double appears=0, alone_s=0; bool here=false, gone=false; double done=0; std::optional<world::trajectory> drive; double line=0; bool has_line=false; std::unique_ptr<speed_planner> sp; double slowest=99; int emergencies=0; double in_lane=0; };
static const double GAP_S=getenv("GAP")?atof(getenv("GAP")):1.0;
int main(int argc,char**argv){
  int seeds=argc>1?atoi(argv[1]):3; int each=getenv("EACH")?atoi(getenv("EACH")):3; double every=argc>2?atof(argv[2]):4; bool verbose=argc>3;
  auto map=toy::cross_roads(true);
  world::vehicle_params body;
  comfort_limits style; style.horizon_s=40;
  auto lanes=std::make_shared<const lane_network>(map);
  std::vector<route_profile_ptr> ways; std::vector<std::pair<int,int>> arms;
  for(size_t in=1;in<=4;++in)for(size_t out=1;out<=4;++out) if(in!=out){ ways.push_back(std::make_shared<const route_profile>(toy::make_route(map,{in,0,out}),comfort_limits{})); arms.push_back({in,out}); }
  std::vector<double> delays; int touch=0; double cpu=0,cpumax=0; long plans=0; int stuck=0; long emerg=0, late=0, early=0, nodrive=0, drives=0;
  for(int seed=1;seed<=seeds;++seed){
    test::dice dice{(uint64_t)seed};
    std::vector<int> order(12); for(int i=0;i<12;++i)order[i]=i; for(int i=11;i>0;--i) std::swap(order[i],order[(int)dice.between(0,i+1)]);
    std::vector<car> cars; unsigned id=101;
    int R=getenv("R")?atoi(getenv("R")):6; for(int r=0;r<R;++r){ double from=dice.between(10,40), first=dice.between(0,2); for(int k=0;k<each;++k){ car c; c.who=station_id{id++}; c.way=ways[order[r]]; c.s=from; c.appears=first+k*every; c.sp=std::make_unique<speed_planner>(c.way,style,speed_planner::grid{1,160}); auto m=drive_freely(*c.way,{},from,0,c.way->line.way().length_m()); c.alone_s=m.time_s(c.way->line.way().length_m()-5);
      { speed_planner sp{c.way,style,{1,160}}; double S=from,V=0,A=0,T=0; while(S<c.way->line.way().length_m()-5&&T<90){ speed_constraints t0; t0.speed_mps=V;t0.accel_mps2=A; sp.plan(centre(c.way->line,S),0,t0); auto&mm=sp.motion(); if(mm.size()<2)break; S+=mm[1].s_m;V=mm[1].speed_mps;A=mm[1].accel_mps2;T+=.1;} c.alone_s=T; } cars.push_back(std::move(c)); } }
    conducting how; how.style=style; crossing_ways cw{lanes,{{0,0},80},body}; crossing_ways mine{lanes,{{0,0},80},body};
    conductor boss{cw,how,body};
    std::vector<crossing_advice> advice;
    int step=0;
    for(double t=0;t<240;t+=0.1,++step){
      time_point now{from_seconds(t)};
      for(auto&c:cars) if(!c.here&&!c.gone&&t>=c.appears){ bool free=true; for(auto&o:cars) if(o.here&&!o.gone&&o.way->line.way().at_lane(o.s).lane==c.way->line.way().at_lane(c.s).lane&&(std::abs(o.s-c.s)<9||(o.s<c.s&&c.s-o.s<9+o.v*1.5+o.v*o.v/3))) free=false; if(free){c.here=true;} }
      if(step%5==0){
        std::vector<approaching_car> all; for(auto&c:cars) if(c.here&&!c.gone) all.push_back({c.who,c.way,c.s,c.v,c.a,true,c.drive});
        if(verbose&&step%100==0) for(auto&c:cars) if(c.here&&!c.gone) std::printf("  CAR t %.0f %u %d>%d s %.1f v %.2f drive %.2f..%.2f\n",t,c.who.value(),arms[std::find(ways.begin(),ways.end(),c.way)-ways.begin()].first,arms[std::find(ways.begin(),ways.end(),c.way)-ways.begin()].second,c.s,c.v,c.drive?to_seconds(c.drive->start):-1,c.drive?to_seconds(c.drive->end()):-1);
        clock_t b=clock(); boss.plan(now,all,advice); double ms=1e3*(clock()-b)/CLOCKS_PER_SEC; if(t>1){cpu+=ms; cpumax=std::max(cpumax,ms); ++plans;}
        for(auto&a:advice) for(auto&c:cars) if(c.who==a.who){ c.line=a.line_m; c.has_line=true; if(!a.drive.empty()) {c.drive=a.drive;++drives;} else {c.drive.reset(); ++nodrive;} if(verbose) std::printf("t %.1f %u s %.1f v %.1f line %.1f %s %.2f\n",t,c.who.value(),c.s,c.v,c.line,a.drive.empty()?"wait":"drive",to_seconds(a.not_before)); }
      }
      for(auto&c:cars){ if(!c.here||c.gone) continue;
        speed_constraints task; task.speed_mps=c.v; task.accel_mps2=c.a; std::vector<speed_constraints::window> w;
        auto lane=c.way->line.way().at_lane(c.s+body.front_m).lane;
        // leader: nearest ahead whose box is on my way
        car*lead=nullptr; double best=1e9; for(auto&o:cars) if(&o!=&c&&o.here&&!o.gone){ auto p=o.way->line.way().path().at(o.s-body.rear_m).at; auto f=c.way->line.way().path().project(p); if(std::abs(f.d_m)<1.2&&std::abs(f.beyond_m)<.5&&f.s_m>c.s+body.front_m-1&&f.s_m<best){ auto q=o.way->line.way().path().at(o.s); auto h=c.way->line.way().path().at(f.s_m).heading_rad; if(std::cos(q.heading_rad-h)>0.8){best=f.s_m; lead=&o; task.ahead=speed_constraints::follower{f.s_m-c.s-body.front_m,{o.v,std::min(0.0,o.a)}}; } } }
        if(c.drive&&to_seconds(c.drive->end()-now)<0) c.drive.reset(), c.has_line=false;
        if(lead&&lead->drive&&getenv("NOPRED")==nullptr){ double t0=to_seconds(lead->drive->start-now); auto&P=lead->drive->points; double last=0; bool any=false;
          for(auto&p:P) if(t0+p.t_s>-0.3){ auto q=lead->way->line.way().path().at(p.s_m-body.rear_m).at; auto f=c.way->line.way().path().project(q); if(std::abs(f.d_m)>1.2||f.beyond_m>.5) continue; double at=f.s_m-body.front_m-2.5-c.s; if(at>last+1.0){ w.push_back({at,t0+p.t_s+GAP_S,1e9}); last=at; any=true; } }
          if(any||P.back().t_s+t0>0) { if(any) task.ahead.reset(); } task.windows=w; }
        std::vector<speed_constraints::appointment> pr;
        auto pl=mine.find(c.way,c.s,200); double L=pl?mine[pl->way].enters_m-mine.middle_m()+pl->lap_m-c.s:-1;
        if(c.drive){ double t0=to_seconds(c.drive->start-now); auto&P=c.drive->points; double stand=-1, leave=-1;
          for(size_t k=0;k+4<P.size();++k) if(P[k].s_m>c.s-0.7&&P[k+4].s_m-P[k].s_m<0.06){ if(stand>=0&&P[k].s_m>stand+.3) break; stand=P[k].s_m; leave=t0+P[k+4].t_s; }
          if(t0>0&&c.v<.3) { stand=c.s; leave=t0; }
          if(stand>=0&&leave>0.05){ task.stop_m=std::max(0.0,stand-c.s)+.1; }
          else { for(auto&p:P) if(p.s_m-c.s>std::max(0.3,L-2)&&(pr.empty()||p.s_m-c.s>pr.back().at_m+.2)) pr.push_back({p.s_m-c.s,t0+p.t_s}); task.promised=pr; task.sooner_s=task.later_s=0.25; }
        }
        else if(c.has_line&&c.line>c.s-0.5) task.stop_m=c.line-c.s+ 0.5;
        else if(L>-0.5) task.stop_m=L+.5;
        if(getenv("PERFECT")&&c.drive){ double T=to_seconds(now-c.drive->start)+.1; auto&P=c.drive->points; if(T>P.back().t_s) {} else if(T>0){ size_t k=0; while(k+2<P.size()&&P[k+1].t_s<T)++k; double f=std::min(1.0,(T-P[k].t_s)/(P[k+1].t_s-P[k].t_s)); double s1=std::lerp(P[k].s_m,P[k+1].s_m,f); if(s1>=c.s-.01){ double v1=(s1-c.s)/.1; c.a=0; c.v=v1; c.s=s1; if(c.s>c.way->line.way().length_m()-5){c.gone=true;c.done=t+.1;} continue;} } else if(c.v<.3) continue; }
        auto r=c.sp->plan(centre(c.way->line,c.s),0,task); auto m=c.sp->motion();
        if(m.size()<2&&!pr.empty()){ ++late; if(getenv("WHY"))std::printf("LATE t %.1f %u s %.1f v %.2f a %.2f line %.1f appointment %.2f at %.1f lead %.1f\n",t,c.who.value(),c.s,c.v,c.a,L,pr[0].time_s,pr[0].at_m,task.ahead?task.ahead->touch_m:-1); task.later_s=1e9; r=c.sp->plan(centre(c.way->line,c.s),0,task); m=c.sp->motion(); }
        if(m.size()<2&&!pr.empty()){ ++early; if(getenv("WHY"))std::printf("EARLY t %.1f %u s %.1f v %.2f a %.2f line %.1f appointment %.2f at %.1f lead %.1f\n",t,c.who.value(),c.s,c.v,c.a,L,pr[0].time_s,pr[0].at_m,task.ahead?task.ahead->touch_m:-1); task.promised={}; if(L>c.v*(.5+c.v/5)) task.stop_m=L+.3; r=c.sp->plan(centre(c.way->line,c.s),0,task); m=c.sp->motion(); }
        if(m.size()<2){ auto w0=task.windows; task.windows={}; r=c.sp->brake_only(task); m=c.sp->motion(); }
        if(r.emergency) {++emerg; c.emergencies++; if(getenv("WHY")) std::printf("EMERG t %.1f %u s %.1f v %.1f a %.1f drive %d line %.1f lead %.1f\n",t,c.who.value(),c.s,c.v,c.a,(int)(bool)c.drive,c.line-c.s,task.ahead?task.ahead->touch_m:-1);}
        (void)lane;
        c.s+=m[1].s_m; c.v=m[1].speed_mps; c.a=m[1].accel_mps2;
        if(c.s>c.way->line.way().length_m()-5){c.gone=true;c.done=t+.1;}
      }
      for(size_t i=0;i<cars.size();++i)for(size_t k=0;k<i;++k){auto&a=cars[i];auto&b=cars[k]; if(!a.here||!b.here||a.gone||b.gone)continue; auto box=[&](car&x){auto p=x.way->line.way().path().at(x.s+1.4675);return oriented_box{p.at,p.heading_rad,5.1,1.89};}; if(overlap(box(a),box(b))){++touch; if(getenv("WHY"))std::printf("TOUCH t %.1f %u s %.1f v %.1f drive %d, %u s %.1f v %.1f drive %d\n",t,a.who.value(),a.s,a.v,(int)!!a.drive,b.who.value(),b.s,b.v,(int)!!b.drive);}}
    }
    if(getenv("STATS"))std::printf("kept %d failed %d\n",boss.kept,boss.failed); double sum=0; for(auto&c:cars){ if(!c.gone){++stuck; std::printf("stuck %u s %.1f v %.2f here %d\n",c.who.value(),c.s,c.v,c.here);} else {delays.push_back(c.done-c.appears-c.alone_s); sum+=delays.back();} }
    std::printf("seed %d mean %.2f\n",seed,sum/cars.size());
  }
  std::sort(delays.begin(),delays.end()); double m=0; for(auto d:delays)m+=d; m/=delays.size();
  std::printf("cars %zu mean %.2f p95 %.1f max %.1f touch %d stuck %d emerg %ld late %ld early %ld cpu mean %.2f max %.1f ms drives %ld waits %ld\n",delays.size(),m,delays[size_t(.95*delays.size())],delays.back(),touch,stuck,emerg,late,early,cpu/plans,cpumax,drives,nodrive);
}
