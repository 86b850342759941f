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
int main(int argc,char**argv){
  int seeds=argc>1?atoi(argv[1]):3; int each=getenv("EACH")?atoi(getenv("EACH")):3; double every=argc>2?atof(argv[2]):4; bool verbose=argc>3;
  auto map=toy::cross_roads(true);
  world::vehicle_params body;
  comfort_limits style; style.horizon_s=40;
  auto lanes=std::make_shared<const lane_network>(map);
  std::vector<route_profile_ptr> ways; std::vector<std::pair<int,int>> arms;
  for(size_t in=1;in<=4;++in)for(size_t out=1;out<=4;++out) if(in!=out){ ways.push_back(std::make_shared<const route_profile>(toy::make_route(map,{in,0,out}),comfort_limits{})); arms.push_back({in,out}); }
  std::vector<double> delays; int touch=0; double cpu=0,cpumax=0; long plans=0; int stuck=0; long emerg=0, nodrive=0, drives=0;
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
      for(auto&c:cars) if(!c.here&&!c.gone&&t>=c.appears){ bool free=true; for(auto&o:cars) if(o.here&&!o.gone&&o.way->line.way().at_lane(o.s).lane==c.way->line.way().at_lane(c.s).lane&&std::abs(o.s-c.s)<9) free=false; if(free){c.here=true;} }
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
        double best=1e9; for(auto&o:cars) if(&o!=&c&&o.here&&!o.gone){ auto p=o.way->line.way().path().at(o.s-body.rear_m).at; auto f=c.way->line.way().path().project(p); if(std::abs(f.d_m)<1.2&&std::abs(f.beyond_m)<.5&&f.s_m>c.s+body.front_m-1&&f.s_m<best){ auto q=o.way->line.way().path().at(o.s); auto h=c.way->line.way().path().at(f.s_m).heading_rad; if(std::cos(q.heading_rad-h)>0.8){best=f.s_m; task.ahead=speed_constraints::follower{f.s_m-c.s-body.front_m,{o.v,std::min(0.0,o.a)}}; } } }
        if(c.drive&&to_seconds(c.drive->end()-now)<0) c.drive.reset(), c.has_line=false;
        std::vector<speed_constraints::appointment> pr;
        if(c.drive){ double t0=to_seconds(c.drive->start-now); for(auto&p:c.drive->points) if(pr.empty()||p.s_m-c.s>pr.back().at_m+1e-3) pr.push_back({p.s_m-c.s,t0+p.t_s}); task.promised=pr; task.sooner_s=task.later_s=0.25; }
        else if(c.has_line&&c.line>c.s-0.5) task.stop_m=c.line-c.s+ 0.5;
        else if(!c.has_line){ auto pl=mine.find(c.way,c.s,200); if(pl){double l=mine[pl->way].enters_m-mine.middle_m(); if(l>c.s-0.5)task.stop_m=l-c.s+.5;} }
        if(c.drive && c.v<0.3 && to_seconds(c.drive->start-now)>0.1 && c.drive->points[0].s_m>c.s-0.3) task.stop_m=std::max(0.0,c.line-c.s)*0, task.promised={};
        task.windows=w;
        auto r=c.sp->plan(centre(c.way->line,c.s),0,task); auto m=c.sp->motion();
        if(m.size()<2 && verbose && c.drive){ std::printf("FAIL t %.1f %u s %.1f v %.2f a %.2f t_line %.2f..%.2f at %.1f..%.1f lead %.1f status %d viol %.3f it %d\n",t,c.who.value(),c.s,c.v,c.a,pr.empty()?-1:pr.front().time_s,pr.empty()?-1:pr.back().time_s,pr.empty()?-1:pr.front().at_m,pr.empty()?-1:pr.back().at_m,task.ahead?task.ahead->touch_m:-1,(int)r.report.status,r.report.violation,(int)r.report.iterations);
}
        std::vector<speed_constraints::appointment> tail; { auto pl=mine.find(c.way,c.s,200); double L=pl?mine[pl->way].enters_m-mine.middle_m()-c.s:-1; for(auto&x:pr) if(x.at_m>=L-0.5) tail.push_back(x); }
        if(m.size()<2 && c.drive){ task.promised=tail; r=c.sp->plan(centre(c.way->line,c.s),0,task); m=c.sp->motion(); }
        if(m.size()<2 && c.drive){ task.later_s=1e9; r=c.sp->plan(centre(c.way->line,c.s),0,task); m=c.sp->motion(); if(verbose)std::printf("  late ok %zu\n",m.size());
          double stopm=c.v*(0.5+c.v/5)+1; auto pl=mine.find(c.way,c.s,200); double L=pl?mine[pl->way].enters_m-mine.middle_m()-c.s:-1;
          if(m.size()>=2 && L>stopm && L<stopm+c.v*0.15+0.2){ bool late=true; for(size_t i=1;i<m.size();++i) if(m[i].s_m>L){ auto p=task.promised_s(m[i].s_m); late=!p||0.1*i>*p+.45; if(verbose&&late)std::printf("  drops %u late %.2f\n",c.who.value(),p?0.1*i-*p:-1); break; } if(late){ c.drive.reset(); task.promised={}; task.stop_m=L+.3; r=c.sp->plan(centre(c.way->line,c.s),0,task); m=c.sp->motion(); } } }
        if(m.size()<2){ auto w0=task.windows; task.windows={}; r=c.sp->brake_only(task); m=c.sp->motion(); }
        if(r.emergency) {++emerg; c.emergencies++; if(verbose) std::printf("EMERG t %.1f %u s %.1f v %.1f a %.1f drive %d line %.1f lead %.1f\n",t,c.who.value(),c.s,c.v,c.a,(int)(bool)c.drive,c.line-c.s,task.ahead?task.ahead->touch_m:-1);}
        (void)lane;
        c.s+=m[1].s_m; c.v=m[1].speed_mps; c.a=m[1].accel_mps2;
        if(c.s>c.way->line.way().length_m()-5){c.gone=true;c.done=t+.1;}
      }
      for(size_t i=0;i<cars.size();++i)for(size_t k=0;k<i;++k){auto&a=cars[i];auto&b=cars[k]; if(!a.here||!b.here||a.gone||b.gone)continue; auto box=[&](car&x){auto p=x.way->line.way().path().at(x.s+1.4675);return oriented_box{p.at,p.heading_rad,5.1,1.89};}; if(overlap(box(a),box(b))){++touch; if(verbose)std::printf("TOUCH t %.1f %u %u\n",t,a.who.value(),b.who.value());}}
    }
    double sum=0; for(auto&c:cars){ if(!c.gone){++stuck; std::printf("stuck %u s %.1f v %.2f here %d\n",c.who.value(),c.s,c.v,c.here);} else {delays.push_back(c.done-c.appears-c.alone_s); sum+=delays.back();} }
    std::printf("seed %d mean %.2f\n",seed,sum/cars.size());
  }
  std::sort(delays.begin(),delays.end()); double m=0; for(auto d:delays)m+=d; m/=delays.size();
  std::printf("cars %zu mean %.2f p95 %.1f max %.1f touch %d stuck %d emerg %ld cpu mean %.2f max %.1f ms drives %ld waits %ld\n",delays.size(),m,delays[size_t(.95*delays.size())],delays.back(),touch,stuck,emerg,cpu/plans,cpumax,drives,nodrive);
}
